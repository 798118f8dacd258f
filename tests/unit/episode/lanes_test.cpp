#include <lore/episode/lanes.h>

#include "support/trace_client.h"

namespace lore {
namespace {

using test::expect_equal_to_plain_episodes;
using test::random_toy;
using test::ToyWorld;

TEST(RunInBatches, gives_the_episodes_of_record_episode_in_worlds_of_all_shapes) {
    for (std::uint32_t shape = 0; shape < 40; ++shape) {
        Stream rng{30, Purpose::test, 0, shape};
        ToyWorld const world{random_toy(rng)};
        EpisodeConfig const config{1 + static_cast<int>(rng.below(120))};
        int const episodes = 1 + static_cast<int>(rng.below(50)), chunk_steps = 1 + static_cast<int>(rng.below(50));
        SCOPED_TRACE(shape);
        expect_equal_to_plain_episodes(world, episodes, config, chunk_steps, run_in_batches);
    }
}

TEST(RunInLanes, has_no_lane_left_over_where_the_client_has_nothing) {
    ToyWorld const world;
    test::TraceClient client{world, {}};
    run_in_lanes(world, {10}, 5, client);
    EXPECT_TRUE(client.traces().empty());
}

}   // namespace
}   // namespace lore
