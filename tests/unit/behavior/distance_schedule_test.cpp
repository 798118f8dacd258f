#include <lore/behavior/distance_schedule.h>

#include <gtest/gtest.h>

#include <array>

using namespace lore;

TEST(DistanceAt, changes_only_at_the_start_of_a_period) {
    DistanceSchedule const config;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (int g = 0; g < 500; ++g) EXPECT_EQ(distance_at(seed, g, config), distance_at(seed, g / 50 * 50, config));
}

TEST(DistanceAt, draws_every_distance_equally_often_with_repeats) {
    DistanceSchedule const config;
    std::array<int, distance_kinds> seen{};
    int repeats = 0;
    for (int draw = 0; draw < 8000; ++draw) {
        ++seen[static_cast<std::size_t>(distance_at(1, draw * 50, config))];
        repeats += distance_at(1, draw * 50, config) == distance_at(1, draw * 50 + 50, config);
    }
    for (int count : seen) EXPECT_NEAR(count, 2000, 200);   // five standard deviations
    EXPECT_NEAR(repeats, 2000, 200);
}

TEST(DistanceAt, draws_among_the_configured_distances_alone) {
    DistanceSchedule config;
    config.period = 1;
    config.distances = {DistanceKind::entropy};
    for (int g = 0; g < 20; ++g) EXPECT_EQ(distance_at(9, g, config), DistanceKind::entropy);
}
