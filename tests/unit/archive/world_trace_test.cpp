#include <lore/archive/world_trace.h>

#include "support/toy_world.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

using namespace lore;

TEST(WorldTrace, has_a_row_a_step_with_position_channels_and_reward) {
    test::ToyWorld const world;
    Network const network = compile(test::random_genome(world, 1, 5));
    std::string const text = trace_csv(world, network, {3});
    Trace const trace = record_episode(world, network, {3});
    std::string expected = "step,x,y,in0,in1,a0,reward\n";
    for (std::size_t step = 0; step < 3; ++step) {
        // Sensor 0 and the effector are continuous, sensor 1 is binary: bit 0 of the step's word.
        expected += fmt::format("{},{},{},{},{},{},{}\n", step, trace.positions[step].x, trace.positions[step].y,
                                trace.values[2 * step], trace.channel_bits[step] & 1, trace.values[2 * step + 1],
                                trace.rewards[step].amount);
    }
    EXPECT_EQ(text, expected);
}

TEST(WorldTrace, ends_where_the_life_does) {
    test::ToyWorld const world{{.end_above = 4.5f}};
    Network const network = compile(Genome{{2, 1}, {}, {0}});   // the lowest bias: its output is 1 at every step
    std::string const text = trace_csv(world, network, {4000});
    Trace const trace = record_episode(world, network, {4000});
    EXPECT_EQ(trace.steps(), 5);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), trace.steps() + 1);
}
