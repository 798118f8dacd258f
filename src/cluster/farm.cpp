#include <lore/cluster/farm.h>

#include "distance_farm.h"
#include "evaluation_farm.h"

#include <lore/core/stopwatch.h>

#include <fmt/format.h>

#include <cstring>
#include <exception>
#include <utility>

namespace lore {

EvaluationFailure::EvaluationFailure(int index, int rank, Genome genome, std::string reason)
    : Error(fmt::format("an evaluation failed on rank {}", rank), reason, "Resume the run when the cause is mended."),
      index_(index), rank_(rank), genome_(std::move(genome)), reason_(std::move(reason)) {}

struct Farm::Parts {
    Parts(Communicator communicator, EvaluationContext context)
        : state(std::move(communicator)), evaluations(state, std::move(context)), distances(state) {}

    FarmState state;
    EvaluationFarm evaluations;
    DistanceFarm distances;
};

Farm::Farm(Communicator communicator, EvaluationContext context)
    : parts_(std::make_unique<Parts>(std::move(communicator), std::move(context))) {}

Farm::~Farm() {
    if (!parts_->state.working) return;
    try {
        stop();
    } catch (std::exception const&) {
        // The run ends for another reason, which is told; what a damaged rank says of its times is no news.
    }
}

Evaluator& Farm::evaluator() { return parts_->evaluations; }
DistanceMeasurer& Farm::distances() { return parts_->distances; }
bool Farm::broken() const { return parts_->state.broken; }

std::vector<RankTimes> Farm::stop() {
    FarmState& state = parts_->state;
    state.times.processor = processor_seconds();
    std::vector<RankTimes> times{state.times};
    if (!std::exchange(state.working, false)) return times;
    for (int worker = 1; worker < state.ranks(); ++worker) state.post.send(worker, MessageKind::stop, 0, {});
    times.resize(static_cast<std::size_t>(state.ranks()));
    MessageKind const kinds[]{MessageKind::times};
    for (int worker = 1; worker < state.ranks(); ++worker) {
        Message const message = state.post.await(kinds);
        if (message.payload.size() != sizeof(RankTimes)) throw damaged_message("it has other times than this rank's");
        std::memcpy(&times[static_cast<std::size_t>(message.sender)], message.payload.data(), sizeof(RankTimes));
    }
    state.post.flush();
    return times;
}

}   // namespace lore
