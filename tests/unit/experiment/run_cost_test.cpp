#include "run_cost.h"

#include <gtest/gtest.h>

using namespace lore;

TEST(CostForecast, tells_once_what_a_run_will_take_and_leaves_the_founders_out) {
    CostForecast forecast{-1, 4000, 2, 10.0};
    EXPECT_EQ(forecast.after(0, 15.0), "");    // the founders took 5 s
    EXPECT_EQ(forecast.after(1, 15.25), "");   // too short to reckon with
    EXPECT_EQ(forecast.after(20, 15.5), "about 1:40 for 4000 generations (25 ms each so far, on 2 ranks; later ones "
                                        "take more or less)");
    EXPECT_EQ(forecast.after(21, 16.0), "");
}

TEST(CostForecast, of_a_resumed_run_is_about_the_generations_that_are_left) {
    CostForecast forecast{3000, 4000, 1, 0.0};
    EXPECT_EQ(forecast.after(3001, 2.0), "about 33:20 for 1000 generations (2 s each so far, on 1 rank; later ones "
                                         "take more or less)");
}

TEST(CostForecast, says_nothing_of_a_run_that_is_over) {
    CostForecast forecast{-1, 3, 1, 0.0};
    EXPECT_EQ(forecast.after(0, 1.0), "");
    EXPECT_EQ(forecast.after(3, 9.0), "");
}

TEST(CostReport, adds_the_processor_time_of_all_ranks) {
    RankTimes first, second;
    first.processor = 60;
    second.processor = 49.5;
    EXPECT_EQ(cost_report({first, second}, 3'200'000'000, 100.0),
              "cost: 109.5 processor seconds, 3200000000 steps, 32 million steps a second\n");
}
