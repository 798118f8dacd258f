#include <lore/experiment/knowledge_building.h>

#include <lore/archive/all_individuals.h>
#include <lore/core/error.h>
#include <lore/episode/lanes.h>
#include <lore/evolution/lineage.h>
#include <lore/knowledge/builder.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/format.h>

namespace lore {

namespace {

/// Enough to fill the lanes of any processor many times, few enough to keep 100 kB each of several batches.
constexpr std::size_t batch_size = 128;
constexpr std::size_t most_batches_waiting = 2;
constexpr int chunk_steps = 50;

/// Archived individuals in the order of building, and the traces of their evaluations once simulated; element i of each
/// belongs together.
struct Batch {
    std::vector<IndividualId> ids;
    std::vector<int> balls;
    std::vector<Network> networks;
    std::vector<Trace> traces;   ///< without poses

    std::size_t size() const { return ids.size(); }
};

/// Batches from the thread that simulates to the one that matches, in order.
class BatchQueue {
public:
    /// Waits for room. False if the reader has stopped.
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

/// Thrown through a reader of the archive once no more is wanted; never leaves this file.
struct Abandoned {};

/// Where the channels that decide a delivery are among the bits and the values of a step.
constexpr std::size_t place_in(auto const& channels, Channel wanted) {
    std::size_t place = 0;
    while (channels[place] != static_cast<int>(wanted)) ++place;
    return place;
}
constexpr unsigned carrying_bit = 1u << place_in(binary_channels, Channel::carrying);
constexpr std::size_t collect_place = place_in(continuous_channels, Channel::collect);

/// Gathers the sensorimotor records of episodes that run in lanes.
class Recorder : public LaneClient {
public:
    Recorder(Arena const& arena, std::span<Network const> networks, std::vector<Trace>& traces)
        : arena_(arena), networks_(networks), order_(largest_first(networks)), traces_(traces) {}

    Network const* next(int lane) override {
        if (next_ == order_.size()) return nullptr;
        std::size_t const episode = episodes_[static_cast<std::size_t>(lane)] =
            static_cast<std::size_t>(order_[next_++]);
        return &networks_[episode];
    }

    void see(LaneChunk const& chunk, std::span<int const> valid) override {
        auto const width = static_cast<std::size_t>(chunk.width);
        for (std::size_t lane = 0; lane < valid.size(); ++lane) {
            auto const steps = static_cast<std::size_t>(valid[lane]);
            if (steps == 0) continue;
            Trace& trace = traces_[episodes_[lane]];
            record_deliveries(chunk, lane, steps, trace);
            for (std::size_t step = 0; step < steps; ++step)
                trace.channel_bits.push_back(chunk.words[step * width + lane]);
            for (std::size_t i = 0; i < steps * continuous_count; ++i)
                trace.values.push_back(chunk.values[i * width + lane]);
        }
    }

    void rest(int lane, int steps) override {
        Trace& trace = traces_[episodes_[static_cast<std::size_t>(lane)]];
        std::size_t const last = trace.values.size() - continuous_count;
        trace.channel_bits.insert(trace.channel_bits.end(), static_cast<std::size_t>(steps),
                                  std::uint16_t{trace.channel_bits.back()});
        for (int step = 0; step < steps; ++step)
            for (std::size_t i = 0; i < continuous_count; ++i) trace.values.push_back(trace.values[last + i]);
    }

    void end(int lane, WorldState const& final_world) override {
        traces_[episodes_[static_cast<std::size_t>(lane)]].final_world = final_world;
    }

private:
    /// Before the chunk's steps are appended to the trace.
    void record_deliveries(LaneChunk const& chunk, std::size_t lane, std::size_t steps, Trace& trace) const {
        auto const width = static_cast<std::size_t>(chunk.width);
        for (std::size_t step = 0; step < steps; ++step) {
            std::size_t const at = step * width + lane;
            if ((chunk.words[at] & carrying_bit) == 0) continue;
            float const collect = chunk.values[(step * continuous_count + collect_place) * width + lane];
            if (delivers(arena_, {chunk.x[at], chunk.y[at]}, true, collect))
                trace.deliveries.push_back(trace.steps() + static_cast<int>(step));
        }
    }

    Arena const& arena_;
    std::span<Network const> networks_;
    std::vector<int> order_;
    std::size_t next_ = 0;
    std::vector<Trace>& traces_;
    std::array<std::size_t, most_lanes> episodes_{};
};

void simulate(RunDirectory const& run, Batch& batch) {
    batch.traces.resize(batch.size());
    for (Trace& trace : batch.traces) {
        trace.channel_bits.reserve(static_cast<std::size_t>(run.config.episode.steps));
        trace.values.reserve(static_cast<std::size_t>(run.config.episode.steps) * continuous_count);
    }
    Recorder recorder{run.arena, batch.networks, batch.traces};
    run_in_lanes(run.arena, run.config.episode, chunk_steps, recorder);
    for (std::size_t i = 0; i < batch.size(); ++i) {
        assert(std::cmp_equal(batch.traces[i].deliveries.size(), batch.traces[i].final_world.collected));
        if (batch.traces[i].final_world.collected != batch.balls[i])
            throw Error(
                fmt::format("individual {} of {} does not repeat", text(batch.ids[i]), run.path),
                fmt::format("{} balls now, {} in its archive", batch.traces[i].final_world.collected, batch.balls[i]),
                "Build with the version of Lore and the arena file that the run was made with.");
    }
}

/// Calls its argument for each individual in the order of building.
using Source = std::function<void(std::function<void(IndividualId, Genome const&, int balls)> const&)>;

KnowledgeBase build(RunDirectory const& run, Source const& source, KnowledgeConfig const& config, IndexChoice index,
                    Provenance provenance, BuildingObserver const& observe, EvidenceConfig evidence) {
    BatchQueue queue;
    std::thread simulator{[&] {
        try {
            Batch batch;
            auto const send = [&] {
                simulate(run, batch);
                if (!queue.put(std::exchange(batch, {}))) throw Abandoned{};
            };
            source([&](IndividualId id, Genome const& genome, int balls) {
                batch.ids.push_back(id);
                batch.balls.push_back(balls);
                batch.networks.push_back(compile(genome));
                if (batch.size() == batch_size) send();
            });
            if (batch.size() > 0) send();
            queue.finish(nullptr);
        } catch (Abandoned const&) { queue.finish(nullptr); } catch (...) {
            queue.finish(std::current_exception());
        }
    }};
    struct Join {   // also when an exception passes
        BatchQueue& queue;
        std::thread& thread;
        ~Join() {
            queue.abandon();
            thread.join();
        }
    } const join{queue, simulator};

    KnowledgeBuilder builder{config, make_index(index, config), std::move(evidence)};
    int const threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    for (Batch batch = queue.take(); batch.size() > 0; batch = queue.take()) {
        std::vector<Exhibit> exhibits;
        for (std::size_t i = 0; i < batch.size(); ++i)
            exhibits.push_back({windows_of(batch.traces[i], config.window_length), static_cast<double>(batch.balls[i]),
                                batch.traces[i].deliveries, batch.ids[i].generation});
        if (index.kind == IndexKind::exact) {
            builder.add_individuals(exhibits, threads);
        } else {   // what an approximate index misses depends on what it holds, so there the order of searches matters
            for (Exhibit const& exhibit : exhibits) builder.add_individual(exhibit);
        }
        observe(static_cast<std::int64_t>(builder.individuals()), builder.features());
    }
    provenance.index = text(index);
    provenance.sources = {run.path};
    provenance.task = fmt::format("{} {}", run.arena.name, run.arena.task.name);
    return std::move(builder).finish(std::move(provenance));
}

}   // namespace

std::vector<double> default_gammas() { return {0.99, 0.995, 0.998}; }

KnowledgeBase knowledge_of_lineage(RunDirectory const& run, Birth const& individual, KnowledgeConfig const& config,
                                   IndexChoice index, Provenance provenance, BuildingObserver const& observe,
                                   std::vector<double> gammas) {
    provenance.kind = "lineage";
    provenance.best_balls = individual.balls;
    Source const lineage = [&](auto const& each) {
        for (Birth const* ancestor : lineage_of(individual)) each(ancestor->id, ancestor->genome, ancestor->balls);
    };
    EvidenceConfig evidence{std::move(gammas), true, 0};
    return build(run, lineage, config, index, std::move(provenance), observe, std::move(evidence));
}

KnowledgeBase knowledge_of_all(RunDirectory const& run, int every, KnowledgeConfig const& config, IndexChoice index,
                               Provenance provenance, BuildingObserver const& observe, std::vector<double> gammas,
                               int success_balls) {
    assert(every >= 1);
    archived_individuals(run);
    provenance.kind = "all";
    provenance.best_balls = run.individual("best")->balls;
    Source const all_individuals = [&](auto const& each) {
        std::uint64_t number = 0;
        for_each_individual(run.file(run_file::all_individuals), run.lineage.generation,
                            [&](ArchivedIndividual const& individual) {
                                if (number++ % static_cast<std::uint64_t>(every) == 0)
                                    each(individual.id, individual.genome, individual.balls);
                            });
    };
    if (success_balls == 0) success_balls = std::max(1, (provenance.best_balls + 1) / 2);
    EvidenceConfig evidence{std::move(gammas), false, success_balls};
    return build(run, all_individuals, config, index, std::move(provenance), observe, std::move(evidence));
}

std::uint64_t archived_individuals(RunDirectory const& run) {
    if (!std::filesystem::exists(run.file(run_file::all_individuals)))
        throw Error(fmt::format("{} did not keep all individuals", run.path),
                    fmt::format("there is no {}", run_file::all_individuals),
                    "Run 'lore-evolve' with '--archive all', or build from the lineage without --all.");
    return check_all_individuals(run.file(run_file::all_individuals)).individuals;
}

}   // namespace lore
