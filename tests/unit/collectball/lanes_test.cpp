#include <lore/collectball/collectball.h>
#include <lore/collectball/geometry.h>

#include "support/trace_client.h"

namespace lore {
namespace {

using test::expect_equal_to_plain_episodes;

TEST(CollectballWorld, gives_the_same_episodes_alone_in_batches_and_in_its_own_lanes) {
    for (char const* task : {"source", "target"}) {
        CollectballWorld const world{load_arena("collectball", task)};
        expect_equal_to_plain_episodes(world, 40, {300}, 40, run_in_batches);
        expect_equal_to_plain_episodes(world, 40, {300}, 40, run_in_lanes);
    }
}

TEST(CollectballWorld, tells_rewards_in_lanes_at_their_steps_and_when_a_robot_stands_still) {
    // A robot that starts on a ball in the basket delivers it, whatever it does, as soon as it takes it and lets it go.
    Arena arena = load_arena("collectball", "source");
    arena.start = {arena.basket_center.x, arena.basket_center.y, 0};
    for (Point& ball : arena.task.ball_positions) ball = arena.basket_center;
    compile_geometry(arena);
    for (int stop_when_still : {0, 20}) {
        CollectballWorld const world{arena, stop_when_still};
        expect_equal_to_plain_episodes(world, 60, {500}, 40, run_in_lanes);
    }
}

}   // namespace
}   // namespace lore
