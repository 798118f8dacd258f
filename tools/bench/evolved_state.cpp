#include "evolved_state.h"

namespace lore {

std::vector<Descriptors const*> EvolvedState::descriptors() const {
    std::vector<Descriptors const*> pointers;
    for (Individual const& member : pool) pointers.push_back(member.descriptors.get());
    return pointers;
}

EvolvedState const& evolved_state() {
    static EvolvedState const evolved = [] {
        EvolvedState e;
        e.context.arena = load_arena("collectball", "source");
        e.config.generations = 100;
        SerialEvaluator evaluator{e.context};
        std::vector<Individual> parents;
        e.state = evolve(e.config, 1, evaluator, {}, [&](GenerationReport const& report) {
            e.pool = std::move(parents);
            e.pool.insert(e.pool.end(), report.born.begin(), report.born.end());
            parents = report.state->population.members;
            return true;
        });
        return e;
    }();
    return evolved;
}

} // namespace lore
