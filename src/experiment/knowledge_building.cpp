#include <lore/experiment/knowledge_building.h>

#include <lore/archive/all_individuals.h>
#include <lore/core/error.h>
#include <lore/evolution/lineage.h>
#include <lore/knowledge/builder.h>

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include <fmt/format.h>

namespace lore {

namespace {

/// Enough to fill the lanes of any processor many times, few enough to keep 100 kB each of several batches.
constexpr std::size_t batch_size = 128;
constexpr std::size_t most_batches_waiting = 2;

/// An archived individual on its way to be simulated, and then its trace.
struct Ancestor {
    IndividualId id;
    Network network;
    int balls = 0;
    Trace trace;
};
using Batch = std::vector<Ancestor>;

/// Batches from the thread that simulates to the one that matches, in order.
class BatchQueue {
public:
    /// Waits for room. False if nobody will take it any more.
    bool put(Batch batch) {
        std::unique_lock lock{mutex_};
        changed_.wait(lock, [&] { return waiting_.size() < most_batches_waiting || abandoned_; });
        if (abandoned_) return false;
        waiting_.push_back(std::move(batch));
        changed_.notify_all();
        return true;
    }
    /// No batch will follow; `failure` is why, if not because all is done.
    void finish(std::exception_ptr failure) {
        std::lock_guard const lock{mutex_};
        finished_ = true;
        failure_ = failure;
        changed_.notify_all();
    }
    /// Waits for the next one; an empty batch is the end. Rethrows what went wrong on the other side.
    Batch take() {
        std::unique_lock lock{mutex_};
        changed_.wait(lock, [&] { return !waiting_.empty() || finished_; });
        if (waiting_.empty()) {
            if (failure_) std::rethrow_exception(failure_);
            return {};
        }
        Batch batch = std::move(waiting_.front());
        waiting_.pop_front();
        changed_.notify_all();
        return batch;
    }
    void abandon() {
        std::lock_guard const lock{mutex_};
        abandoned_ = true;
        changed_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Batch> waiting_;
    bool finished_ = false, abandoned_ = false;
    std::exception_ptr failure_;
};

/// Thrown through a reader of the archive once nobody wants more; never leaves this file.
struct Abandoned {};

void simulate(RunDirectory const& run, Batch& batch) {
    for (Ancestor& ancestor : batch) ancestor.trace = record_episode(run.arena, ancestor.network, run.config.episode);
    for (Ancestor const& ancestor : batch)
        if (ancestor.trace.final_world.collected != ancestor.balls)
            throw Error(fmt::format("individual {} of {} does not repeat", text(ancestor.id), run.path),
                        fmt::format("{} balls now, {} in its archive", ancestor.trace.final_world.collected, ancestor.balls),
                        "Build with the version of Lore and the arena file that the run was made with.");
}

/// Calls its argument for each individual in the order of building.
using Source = std::function<void(std::function<void(IndividualId, Genome const&, int balls)> const&)>;

KnowledgeBase build(RunDirectory const& run, Source const& source, KnowledgeConfig const& config, IndexKind kind,
                    Provenance provenance, BuildingObserver const& observe) {
    BatchQueue queue;
    std::thread simulator{[&] {
        try {
            Batch batch;
            auto const send = [&] {
                simulate(run, batch);
                if (!queue.put(std::move(batch))) throw Abandoned{};
                batch.clear();
            };
            source([&](IndividualId id, Genome const& genome, int balls) {
                batch.push_back({id, compile(genome), balls, {}});
                if (batch.size() == batch_size) send();
            });
            if (!batch.empty()) send();
            queue.finish(nullptr);
        } catch (Abandoned const&) {
            queue.finish(nullptr);
        } catch (...) {
            queue.finish(std::current_exception());
        }
    }};
    struct Join {   // also when an exception passes
        BatchQueue& queue;
        std::thread& thread;
        ~Join() { queue.abandon(); thread.join(); }
    } const join{queue, simulator};

    KnowledgeBuilder builder{config, make_index(kind, config)};
    for (Batch batch = queue.take(); !batch.empty(); batch = queue.take()) {
        for (Ancestor const& ancestor : batch) builder.add_individual(windows_of(ancestor.trace, config.window_length), ancestor.balls);
        observe(static_cast<std::int64_t>(builder.individuals()));
    }
    provenance.index = name(kind);
    provenance.sources = {run.path};
    provenance.task = fmt::format("{} {}", run.arena.name, run.arena.task.name);
    return std::move(builder).finish(std::move(provenance));
}

} // namespace

KnowledgeBase knowledge_of_lineage(RunDirectory const& run, Birth const& individual, KnowledgeConfig const& config, IndexKind kind,
                                   Provenance provenance, BuildingObserver const& observe) {
    provenance.kind = "lineage";
    provenance.best_balls = individual.balls;
    Source const lineage = [&](auto const& each) {
        for (Birth const* ancestor : lineage_of(individual)) each(ancestor->id, ancestor->genome, ancestor->balls);
    };
    return build(run, lineage, config, kind, std::move(provenance), observe);
}

KnowledgeBase knowledge_of_all(RunDirectory const& run, KnowledgeConfig const& config, IndexKind kind, Provenance provenance,
                               BuildingObserver const& observe) {
    archived_individuals(run);
    provenance.kind = "all";
    provenance.best_balls = run.individual("best")->balls;
    Source const everybody = [&](auto const& each) {
        for_each_individual(run.file(run_file::all_individuals), run.lineage.generation,
                            [&](ArchivedIndividual const& individual) { each(individual.id, individual.genome, individual.balls); });
    };
    return build(run, everybody, config, kind, std::move(provenance), observe);
}

std::uint64_t archived_individuals(RunDirectory const& run) {
    if (!std::filesystem::exists(run.file(run_file::all_individuals)))
        throw Error(fmt::format("{} did not keep all individuals", run.path), fmt::format("there is no {}", run_file::all_individuals),
                    "Run 'lore-evolve' with '--archive all', or build from the lineage without --all.");
    return check_all_individuals(run.file(run_file::all_individuals)).individuals;
}

} // namespace lore
