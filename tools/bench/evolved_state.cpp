#include "evolved_state.h"

#include "learned_base.h"

#include <lore/collectball/collectball.h>

namespace lore {

std::vector<Descriptors const*> EvolvedState::descriptors() const {
    std::vector<Descriptors const*> pointers;
    for (Individual const& member : pool) pointers.push_back(member.descriptors.get());
    return pointers;
}

std::shared_ptr<World const> collectball(std::string const& task) {
    return std::make_shared<CollectballWorld>(load_arena("collectball", task));
}

EvolvedState evolve_for(int generations, std::uint64_t seed, EvaluationContext context, EvolutionConfig config) {
    EvolvedState e{std::move(context), config, {}, {}};
    e.config.interface = Interface{Channels{e.context.world->facts()}};
    e.config.generations = generations;
    SerialEvaluator evaluator{e.context};
    std::vector<Individual> parents;
    e.state = evolve(e.config, seed, evaluator, {}, [&](GenerationReport const& report) {
        e.pool = std::move(parents);
        e.pool.insert(e.pool.end(), report.born.begin(), report.born.end());
        parents = report.state->population.members;
        return true;
    });
    return e;
}

EvolvedState const& evolved_state() {
    static EvolvedState const evolved = evolve_for(100, 1, {collectball("source"), {}, std::nullopt});
    return evolved;
}

EvolvedState const& evolved_with_knowledge() {
    static EvolvedState const evolved = [] {
        EvolutionConfig config;
        config.use_shaping = true;
        return evolve_for(50, 1, {collectball("target"), {}, Shaper{learned_base()}}, config);
    }();
    return evolved;
}

}   // namespace lore
