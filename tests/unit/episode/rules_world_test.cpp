#include <lore/episode/rules_world.h>

#include <lore/core/isa.h>

#include "support/trace_client.h"

namespace lore {
namespace {

/// Rules with binary channels of both kinds, more channels than a word has bits, and lives that end at steps that
/// depend on what they do.
struct ToyRules {
    static constexpr int sensors = 15, effectors = 3;
    static constexpr bool binary[sensors + effectors] = {false, true,  false, false, true,  false, false, false, true,
                                                         false, false, false, false, false, false, false, true,  false};
    float end_above;

    template <class F>
    struct State {
        F x, y, done;
    };
    LORE_INLINE State<float> start() const { return {0.5f, 0.25f, 0}; }
    template <class F>
    LORE_INLINE void sense(State<F> const& state, F* values) const {
        for (int s = 0; s < sensors; ++s) {
            F const value = state.x * (1.0f / static_cast<float>(s + 1));
            values[s] = binary[s] ? lanes::select(value > 0.05f, lanes::all_of<F>(1.0f), F{}) : value;
        }
    }
    template <class F>
    LORE_INLINE LaneStep<F> act(State<F>& state, F const* outputs) const {
        state.done = state.done + outputs[0] + outputs[1];
        state.x = state.x * 0.75f + outputs[2] * 0.25f;
        state.y = outputs[0];
        return {F(outputs[2] - 0.5f), state.done > end_above};
    }
    LORE_INLINE void outcome(State<float> const& state, float* values) const { values[0] = state.done; }
};

void run_toys(LaneRulesWork const& work) { run_rules<ToyRules, lanes_of(Isa::baseline)>(work); }

RulesWorld<ToyRules> toy(float end_above) {
    WorldFacts facts;
    facts.name = "toy";
    facts.task = "test";
    facts.reward_unit = "points";
    for (int c = 0; c < ToyRules::sensors + ToyRules::effectors; ++c)
        (c < ToyRules::sensors ? facts.sensors : facts.effectors)
            .push_back({"channel_" + std::to_string(c), ToyRules::binary[c]});
    facts.outcome_size = 1;
    return {facts, ToyRules{end_above}, [] { return &run_toys; }};
}

TEST(RulesWorld, gives_the_same_lives_alone_in_batches_and_in_lanes) {
    use_isa(Isa::baseline);
    for (float const end_above : {1e9f, 60.0f, 20.0f, 3.0f}) {
        auto const world = toy(end_above);
        for (int const chunk_steps : {1, 9, 40})
            for (int const episodes : {1, 4, 5, 37}) {
                test::expect_equal_to_plain_episodes(world, episodes, {70}, chunk_steps, run_in_lanes);
                test::expect_equal_to_plain_episodes(world, episodes, {70}, chunk_steps, run_in_batches);
            }
    }
    use_isa(detected_isa());
}

}   // namespace
}   // namespace lore
