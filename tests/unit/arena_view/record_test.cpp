#include <lore/arena_view/record.h>

#include <support/toy_world.h>

#include <gtest/gtest.h>

namespace lore {
namespace {

TEST(ArenaReplay, shows_each_step_as_it_was_before_its_action) {
    Arena const arena = load_arena("collectball", "source");
    std::vector<StepRecord> steps(2);
    steps[0].pose.theta = 1;
    steps[0].carrying = true;
    steps[0].balls_mask = 5;
    steps[1].pose.theta = 2;
    ArenaReplay const replay = arena_replay(arena, steps);
    ASSERT_EQ(replay.steps.size(), 2u);
    EXPECT_EQ(replay.steps[0].theta, 1);
    EXPECT_FALSE(replay.steps[0].carrying) << "the first step takes the ball";
    EXPECT_EQ(replay.steps[0].balls_mask, start_world(arena).balls_mask);
    EXPECT_EQ(replay.steps[1].theta, 2);
    EXPECT_TRUE(replay.steps[1].carrying);
    EXPECT_EQ(replay.steps[1].balls_mask, 5u);
    EXPECT_EQ(page_events(replay.steps).substr(0, 7), "[[0,0,0");
}

TEST(ArenaScene, reads_back_to_the_bit) {
    for (char const* task : {"source", "target"}) {
        ArenaScene const scene = scene_of(load_arena("collectball", task));
        EXPECT_EQ(parse_arena_scene(to_json(scene)), scene);
    }
    EXPECT_THROW(parse_arena_scene("{}"), std::exception);
}

TEST(ArenaWorld, is_found_behind_a_world_that_is_one) {
    EXPECT_EQ(arena_world(std::make_shared<test::ToyWorld const>()), nullptr);
    auto const world = std::make_shared<CollectballWorld const>(load_arena("collectball", "source"));
    EXPECT_EQ(arena_world(world), world);
}

}   // namespace
}   // namespace lore
