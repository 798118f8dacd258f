#include <lore/episode/episode.h>

#include <lore/core/random.h>

#include <gtest/gtest.h>

namespace lore {
namespace {

/// A controller whose outputs are constants: no edges, only biases (genes).
Network constant_outputs(float left, float right, float collect) {
    Genome genome;
    genome.biases = {left, right, collect};
    return compile(genome);
}

Network random_network(std::uint32_t slot) { return compile(founder(Stream{11, Purpose::test, 0, slot})); }

TEST(Episode, logs_what_a_robot_that_stands_still_senses) {
    Arena const arena = load_arena("collectball", "source");
    Trace const trace = record_episode(arena, constant_outputs(0.5f, 0.5f, 0.5f), {});
    ASSERT_EQ(trace.steps(), 4000);
    ASSERT_EQ(trace.values.size(), 6u * 4000u);
    Sensors const sensors = sense(arena, start_robot(arena), start_world(arena));
    for (std::size_t step : {0u, 1u, 3999u}) {
        EXPECT_EQ(trace.poses[step], arena.start);
        EXPECT_EQ(trace.values[6 * step + 2], sensors[2]);
        EXPECT_EQ(trace.values[6 * step + 5], 0.5f);
        EXPECT_EQ(trace.channel_bits[step], channel_bits(sensors, {0.5f, 0.5f, 0.5f}));
    }
    EXPECT_EQ(trace.final_world.collected, 0);
}

TEST(Episode, logs_sensors_and_pose_before_the_move_and_effectors_of_the_same_step) {
    Arena const arena = load_arena("collectball", "source");
    Trace const trace = record_episode(arena, constant_outputs(0.4f, 0.4f, 0.5f), {});   // forwards
    EXPECT_EQ(trace.poses[0], arena.start);
    EXPECT_NE(trace.poses[1], arena.start);
    EXPECT_EQ(trace.values[0], sense(arena, start_robot(arena), start_world(arena))[0]);
    EXPECT_GT(trace.values[3], 0.5f);
}

TEST(TraceBits, hold_the_binary_channels_then_the_thresholded_ones) {
    Sensors sensors{};
    Effectors effectors{};
    EXPECT_EQ(channel_bits(sensors, effectors), 0);
    sensors[3] = 1;
    EXPECT_EQ(channel_bits(sensors, effectors), 1u << 0) << "ball_right is the first binary channel";
    sensors[11] = 1;
    EXPECT_EQ(channel_bits(sensors, effectors), 1u << 0 | 1u << 8);
    sensors[0] = 0.5f;
    EXPECT_EQ(channel_bits(sensors, effectors), 1u << 0 | 1u << 8) << "exactly half the range is not nearer";
    sensors[0] = 0.51f;
    effectors[2] = 0.51f;
    EXPECT_EQ(channel_bits(sensors, effectors), 1u << 0 | 1u << 8 | 1u << 9 | 1u << 14);
}

TEST(Episode, is_seen_by_an_observer_as_it_is_recorded) {
    Arena const arena = load_arena("collectball", "source");
    for (std::uint32_t slot = 0; slot < 5; ++slot) {
        Network const network = random_network(slot);
        Trace const trace = record_episode(arena, network, {});
        int steps = 0;
        Pose last;
        WorldState const world = run_episode(arena, network, {}, [&](StepView const& view) {
            ASSERT_EQ(view.step, steps);
            ASSERT_EQ(view.pose, trace.poses[static_cast<std::size_t>(steps)]);
            ASSERT_EQ(channel_bits(view.sensors, view.effectors), trace.channel_bits[static_cast<std::size_t>(steps)]);
            ASSERT_TRUE(steps == 0 || view.pose == last);
            last = view.next.pose;
            ++steps;
        });
        EXPECT_EQ(steps, 4000);
        EXPECT_EQ(world, trace.final_world);
    }
}

TEST(Episode, stops_when_still_after_more_than_the_given_number_of_still_steps) {
    Arena const arena = load_arena("collectball", "source");
    EpisodeConfig config;
    config.stop_when_still = 100;
    EXPECT_EQ(record_episode(arena, constant_outputs(0.5f, 0.5f, 0.5f), config).steps(), 101);
    EXPECT_EQ(record_episode(arena, constant_outputs(0.4f, 0.6f, 0.5f), config).steps(), 4000) << "turning is no rest";
}

TEST(Episode, is_a_prefix_when_it_is_shorter) {
    Arena const arena = load_arena("collectball", "target");
    Network const network = random_network(9);
    EpisodeConfig shorter;
    shorter.steps = 500;
    Trace const part = record_episode(arena, network, shorter), whole = record_episode(arena, network, {});
    ASSERT_EQ(part.steps(), 500);
    EXPECT_TRUE(std::equal(part.channel_bits.begin(), part.channel_bits.end(), whole.channel_bits.begin()));
    EXPECT_TRUE(std::equal(part.poses.begin(), part.poses.end(), whole.poses.begin()));
}

}   // namespace
}   // namespace lore
