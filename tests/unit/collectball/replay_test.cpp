#include <lore/collectball/replay.h>

#include <lore/core/random.h>

#include <gtest/gtest.h>

namespace lore {
namespace {

std::vector<StepRecord> random_journey(Arena const& arena, std::uint32_t slot) {
    Stream rng{21, Purpose::test, 0, slot};
    std::vector<Effectors> actions;
    Effectors action{};
    for (int step = 0; step < 2000; ++step) {
        if (step % 25 == 0)
            action = {static_cast<float>(rng.uniform(0.3, 1)), static_cast<float>(rng.uniform(0.3, 1)),
                      static_cast<float>(rng.uniform(0.4, 1))};
        actions.push_back(action);
    }
    return drive(arena, actions);
}

Network random_network(std::uint32_t slot) {
    return compile(founder(Interface{collectball_channels()}, Stream{11, Purpose::test, 0, slot}));
}

TEST(RecordSteps, says_what_the_recorded_episode_says) {
    for (int stop_when_still : {0, 20}) {
        CollectballWorld const world{load_arena("collectball", "source"), stop_when_still};
        Network const network = random_network(3);
        std::vector<StepRecord> const rows = record_steps(world, network, {});
        Trace const trace = record_episode(world, network, {});
        ASSERT_EQ(rows.size(), static_cast<std::size_t>(trace.steps()));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            ASSERT_EQ(rows[i].step, static_cast<int>(i));
            ASSERT_EQ((Position{rows[i].pose.x, rows[i].pose.y}), trace.positions[i]);
            ASSERT_EQ(rows[i].sensors[0], trace.values[6 * i]);
            ASSERT_EQ(rows[i].effectors[2], trace.values[6 * i + 5]);
            ASSERT_TRUE(i == 0 || rows[i - 1].next == rows[i].pose);
        }
        EXPECT_EQ(rows.back().collected, trace.reward);
    }
}

TEST(Drive, repeats_an_episode_from_its_actions) {
    CollectballWorld const world{load_arena("collectball", "source")};
    std::vector<StepRecord> const rows = record_steps(world, random_network(5), {});
    std::vector<Effectors> actions;
    for (StepRecord const& row : rows) actions.push_back(row.effectors);
    EXPECT_EQ(drive(world.arena(), actions), rows);
}

TEST(Follow, leaves_a_record_of_its_own_simulation_as_it_is) {
    for (char const* task : {"source", "target"}) {
        Arena const arena = load_arena("collectball", task);
        for (std::uint32_t slot = 0; slot < 5; ++slot) {
            std::vector<StepRecord> const rows = random_journey(arena, slot);
            EXPECT_EQ(follow(arena, rows), rows) << task << slot;
        }
    }
}

TEST(Follow, takes_each_row_from_its_recorded_state) {
    Arena const arena = load_arena("collectball", "source");
    std::vector<StepRecord> rows = random_journey(arena, 1);
    rows[10].pose = {97.5f, 60.0f, 1.0f};   // beside ball 4
    rows[10].effectors = {0.5f, 0.5f, 1.0f};
    std::vector<StepRecord> const followed = follow(arena, rows);
    EXPECT_TRUE(followed[10].carrying);
    EXPECT_EQ(followed[10].balls_mask, 255 & ~16);
    EXPECT_EQ(followed[11], rows[11]) << "the row after it starts from the record again";
}

}   // namespace
}   // namespace lore
