#include <lore/experiment/knowledge_building.h>

#include <lore/archive/all_individuals.h>
#include <lore/core/error.h>
#include <lore/core/whole_number.h>
#include <lore/episode/lanes.h>
#include <lore/evolution/lineage.h>
#include <lore/knowledge/builder.h>
#include <lore/world/reward_text.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
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
    std::vector<double> rewards;
    std::vector<Network> networks;
    std::vector<Trace> traces;   ///< without positions and outcomes

    std::size_t size() const { return ids.size(); }
};

/// Batches from the thread that simulates to the one that matches, in order. The one that simulates is a guest of the
/// crew that shares the matching: it helps there as long as a batch is waiting.
class BatchQueue {
public:
    explicit BatchQueue(Crew& crew) : crew_(crew) {}

    /// Waits for room. False if the reader has stopped.
    bool put(Batch batch) {
        crew_.assist_until([&] {
            std::lock_guard const lock{mutex_};
            return waiting_.size() < most_batches_waiting || abandoned_;
        });
        std::lock_guard const lock{mutex_};
        if (abandoned_) return false;
        waiting_.push_back(std::move(batch));
        changed_.notify_all();
        return true;
    }
    /// No batch will follow; `failure` is why, if not because all is done. Returns when the reader has stopped.
    void finish(std::exception_ptr failure) {
        {
            std::lock_guard const lock{mutex_};
            finished_ = true;
            failure_ = failure;
            changed_.notify_all();
        }
        crew_.assist_until([&] {
            std::lock_guard const lock{mutex_};
            return abandoned_;
        });
    }
    /// Helps with the matching unless that is about to wait for a batch.
    void assist() {
        {
            std::lock_guard const lock{mutex_};
            if (waiting_.empty()) return;
        }
        crew_.assist();
    }
    /// Waits for the next one; an empty batch is the end. Rethrows what went wrong on the other side.
    Batch take() {
        Batch batch;
        {
            std::unique_lock lock{mutex_};
            changed_.wait(lock, [&] { return !waiting_.empty() || finished_; });
            if (!waiting_.empty()) {
                batch = std::move(waiting_.front());
                waiting_.pop_front();
            } else if (failure_) std::rethrow_exception(failure_);
        }
        crew_.wake();
        return batch;
    }
    void abandon() {
        {
            std::lock_guard const lock{mutex_};
            abandoned_ = true;
        }
        crew_.wake();
    }

private:
    Crew& crew_;   // never called with the mutex locked
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Batch> waiting_;
    bool finished_ = false, abandoned_ = false;
    std::exception_ptr failure_;
};

/// Thrown through a reader of the archive once no more is wanted; never leaves this file.
struct Abandoned {};

/// Gathers the sensorimotor records of episodes that run in lanes.
class Recorder : public LaneClient {
public:
    /// `meanwhile` is called every now and then.
    Recorder(Channels const& channels, std::span<Network const> networks, std::vector<Trace>& traces,
             std::function<void()> const& meanwhile)
        : words_(static_cast<std::size_t>(channels.words())),
          continuous_(static_cast<std::size_t>(channels.continuous_count())), networks_(networks),
          order_(largest_first(networks)), traces_(traces), meanwhile_(meanwhile) {}

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
            firsts_[lane] = static_cast<int>(trace.channel_bits.size() / words_);
            append(trace.channel_bits, chunk.words + lane, steps * words_, width);
            append(trace.values, chunk.values + lane, steps * continuous_, width);
        }
        for (LaneReward const& reward : chunk.rewards) {
            auto const lane = static_cast<std::size_t>(reward.lane);
            traces_[episodes_[lane]].rewards.push_back({firsts_[lane] + reward.row, reward.amount});
        }
        meanwhile_();
    }

    void rest(int lane, int steps) override {
        Trace& trace = traces_[episodes_[static_cast<std::size_t>(lane)]];
        std::size_t const bits = trace.channel_bits.size() - words_, values = trace.values.size() - continuous_;
        for (int step = 0; step < steps; ++step) {
            for (std::size_t i = 0; i < words_; ++i) trace.channel_bits.push_back(trace.channel_bits[bits + i]);
            for (std::size_t i = 0; i < continuous_; ++i) trace.values.push_back(trace.values[values + i]);
        }
    }

    void end(int lane, LaneEnd const& end) override {
        traces_[episodes_[static_cast<std::size_t>(lane)]].reward = end.reward;
    }

private:
    /// Every stride-th item.
    template <class T>
    static void append(std::vector<T>& to, T const* items, std::size_t count, std::size_t stride) {
        to.resize(to.size() + count);
        T* const out = to.data() + to.size() - count;
        for (std::size_t i = 0; i < count; ++i) out[i] = items[i * stride];
    }

    std::size_t words_, continuous_;
    std::span<Network const> networks_;
    std::vector<int> order_;
    std::size_t next_ = 0;
    std::vector<Trace>& traces_;
    std::function<void()> const& meanwhile_;
    std::array<std::size_t, most_lanes> episodes_{};
    std::array<int, most_lanes> firsts_{};   ///< the step of the episode at which the chunk begins
};

void simulate(RunDirectory const& run, Batch& batch, std::function<void()> const& meanwhile) {
    World const& world = *run.world.world;
    Channels const channels{world.facts()};
    auto const steps = static_cast<std::size_t>(run.config.episode.steps);
    batch.traces.resize(batch.size());
    for (Trace& trace : batch.traces) {
        trace.channels = channels;
        trace.channel_bits.reserve(steps * static_cast<std::size_t>(channels.words()));
        trace.values.reserve(steps * static_cast<std::size_t>(channels.continuous_count()));
    }
    Recorder recorder{channels, batch.networks, batch.traces, meanwhile};
    run_in_lanes(world, run.config.episode, chunk_steps, recorder);
    for (std::size_t i = 0; i < batch.size(); ++i) {
        if (batch.traces[i].reward != batch.rewards[i])
            throw Error(fmt::format("individual {} of {} does not repeat", text(batch.ids[i]), run.path),
                        fmt::format("{} now, {} in its archive",
                                    reward_text(batch.traces[i].reward, world.facts().reward_unit),
                                    reward_text(batch.rewards[i])),
                        "Build with the version of Lore and the world that the run was made with.");
    }
}

/// Calls its argument for each individual in the order of building.
using Source = std::function<void(std::function<void(IndividualId, Genome const&, double reward)> const&)>;

KnowledgeBase build(RunDirectory const& run, Source const& source, KnowledgeConfig config, IndexChoice index,
                    Provenance provenance, BuildingObserver const& observe, EvidenceConfig evidence,
                    std::string const& folder = {}) {
    config.channels = Channels{run.world.world->facts()};
    // At least the one that matches, which is this, and its guest, which simulates.
    int const threads = std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
    Crew crew{threads, 1};
    BatchQueue queue{crew};
    std::thread simulator{[&] {
        try {
            Batch batch;
            auto const send = [&] {
                simulate(run, batch, [&] { queue.assist(); });
                if (!queue.put(std::exchange(batch, {}))) throw Abandoned{};
            };
            source([&](IndividualId id, Genome const& genome, double reward) {
                batch.ids.push_back(id);
                batch.rewards.push_back(reward);
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

    KnowledgeBuilder builder{config, make_index(index, config, folder), std::move(evidence)};
    for (Batch batch = queue.take(); batch.size() > 0; batch = queue.take()) {
        std::vector<Exhibit> exhibits;
        for (std::size_t i = 0; i < batch.size(); ++i)
            exhibits.push_back({windows_of(batch.traces[i], config.window_length), batch.rewards[i],
                                batch.traces[i].rewards, batch.ids[i].generation});
        builder.add_individuals(exhibits, crew);
        observe(static_cast<std::int64_t>(builder.individuals()), builder.features());
    }
    provenance.index = text(index);
    provenance.sources = {run.path};
    WorldFacts const& facts = run.world.world->facts();
    provenance.task = fmt::format("{} {}", facts.name, facts.task);
    provenance.reward_unit = facts.reward_unit;
    return std::move(builder).finish(std::move(provenance));
}

void refuse_without_archive(RunDirectory const& run) {
    if (!std::filesystem::exists(run.file(run_file::all_individuals)))
        throw Error(fmt::format("{} did not keep all individuals", run.path),
                    fmt::format("there is no {}", run_file::all_individuals),
                    "Run 'lore-evolve' with '--archive all', or build from the lineage without --all.");
}

}   // namespace

std::vector<double> default_gammas() { return {0.99, 0.995, 0.998}; }

double usual_success(double best) {
    return is_whole(best) && best >= 0 ? std::max(1.0, std::ceil(best / 2)) : best / 2;
}

KnowledgeBase knowledge_of_lineage(RunDirectory const& run, Birth const& individual, KnowledgeConfig const& config,
                                   IndexChoice index, Provenance provenance, BuildingObserver const& observe,
                                   std::vector<double> gammas) {
    provenance.kind = "lineage";
    provenance.best_reward = individual.reward;
    Source const lineage = [&](auto const& each) {
        for (Birth const* ancestor : lineage_of(individual)) each(ancestor->id, ancestor->genome, ancestor->reward);
    };
    EvidenceConfig evidence{std::move(gammas), true, {}};
    return build(run, lineage, config, index, std::move(provenance), observe, std::move(evidence));
}

KnowledgeBase knowledge_of_all(RunDirectory const& run, int every, KnowledgeConfig const& config, IndexChoice index,
                               Provenance provenance, BuildingObserver const& observe, std::vector<double> gammas,
                               std::optional<double> success_reward, std::string const& folder) {
    assert(every >= 1);
    refuse_without_archive(run);
    provenance.kind = "all";
    provenance.best_reward = run.individual("best")->reward;
    Source const all_individuals = [&](auto const& each) {
        std::uint64_t number = 0;
        for_each_individual(run.file(run_file::all_individuals), run.lineage.generation,
                            [&](ArchivedIndividual const& individual) {
                                if (number++ % static_cast<std::uint64_t>(every) == 0)
                                    each(individual.id, individual.genome, individual.reward);
                            });
    };
    if (!success_reward) success_reward = usual_success(provenance.best_reward);
    EvidenceConfig evidence{std::move(gammas), false, success_reward};
    return build(run, all_individuals, config, index, std::move(provenance), observe, std::move(evidence), folder);
}

std::uint64_t archived_individuals(RunDirectory const& run) {
    refuse_without_archive(run);
    return check_all_individuals(run.file(run_file::all_individuals)).individuals;
}

}   // namespace lore
