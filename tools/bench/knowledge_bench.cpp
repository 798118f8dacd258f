// Knowledge: building a base and asking for the nearest feature, the exact index beside the scan that defines it and
// FLANN's forest, on windows of evolved individuals.
#include "evolved_state.h"

#include <lore/core/isa.h>
#include <lore/evolution/lineage.h>
#include <lore/knowledge/builder.h>
#include <lore/knowledge/shaping.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

namespace lore {

namespace {

constexpr std::size_t most_ancestors = 600;   // 120 000 windows, the length of a long lineage

struct Lives {
    std::vector<Trace> traces;
    std::vector<int> balls;
    std::vector<std::vector<Window>> windows;   ///< [individual]

    Lives(EvolvedState const& evolved, std::vector<Birth const*> const& individuals) {
        for (Birth const* individual : individuals) {
            traces.push_back(record_episode(evolved.context.arena, compile(individual->genome), evolved.context.episode));
            balls.push_back(individual->balls);
        }
        for (Trace const& trace : traces) windows.push_back(windows_of(trace, KnowledgeConfig{}.window_length));
    }
};

/// Those a base is built from: ancestors of the population, the youngest first.
Lives const& ancestors() {
    static Lives const lives{evolved_state(), [] {
        std::vector<Birth const*> all = ancestors_of(evolved_state().state.population.members);
        std::reverse(all.begin(), all.end());
        all.resize(std::min(all.size(), most_ancestors));
        return all;
    }()};
    return lives;
}

/// Those that are compared with it: the last generation's children.
Lives const& children() {
    static Lives const lives{evolved_state(), [] {
        std::vector<Birth const*> born;
        auto const& pool = evolved_state().pool;
        for (std::size_t i = pool.size() / 2; i < pool.size(); ++i) born.push_back(pool[i].birth.get());
        return born;
    }()};
    return lives;
}

KnowledgeBase build_with(std::unique_ptr<FeatureIndex> index) {
    KnowledgeBuilder builder{{}, std::move(index)};
    for (std::size_t i = 0; i < ancestors().windows.size(); ++i) builder.add_individual(ancestors().windows[i], ancestors().balls[i]);
    return std::move(builder).finish({});
}

KnowledgeBase const& base() {
    static KnowledgeBase const built = build_with(make_exact_index({}));
    return built;
}

using Maker = std::unique_ptr<FeatureIndex> (*)();

std::unique_ptr<FeatureIndex> scan() { return make_scan_index({}); }
std::unique_ptr<FeatureIndex> exact() { return make_exact_index({}); }
std::unique_ptr<FeatureIndex> flann_32() { return make_flann_index({}, 4, 32); }
std::unique_ptr<FeatureIndex> flann_128() { return make_flann_index({}, 4, 128); }

void build(benchmark::State& state, Maker make, Isa isa) {
    Isa const before = active_isa();
    use_isa(isa);
    ancestors();
    int features = 0;
    for (auto _ : state) features = build_with(make()).size();
    use_isa(before);
    state.counters["features"] = features;
    state.counters["windows"] = benchmark::Counter(static_cast<double>(ancestors().windows.size() * ancestors().windows[0].size()),
                                                   benchmark::Counter::kIsIterationInvariantRate);
}

void query(benchmark::State& state, Maker make, Isa isa) {
    Isa const before = active_isa();
    use_isa(isa);
    auto const index = make();
    for (int feature = 0; feature < base().size(); ++feature) index->add(base().window(feature));
    auto const search = index->search();
    std::size_t individual = 0, asked = 0, found = 0;
    auto const& lives = children().windows;
    for (auto _ : state) {   // an individual at a time
        for (Window const& window : lives[individual % lives.size()]) found += search->match(window).found();
        asked += lives[individual % lives.size()].size();
        ++individual;
    }

    // Recall, of those who were asked for, against the exact answers.
    auto const truth_index = exact();
    for (int feature = 0; feature < base().size(); ++feature) truth_index->add(base().window(feature));
    auto const truth = truth_index->search();
    std::size_t true_matches = 0;
    for (std::size_t i = 0; i < individual; ++i)
        for (Window const& window : lives[i % lives.size()]) true_matches += truth->match(window).found();
    use_isa(before);
    state.counters["features"] = base().size();
    state.counters["recall"] = static_cast<double>(found) / static_cast<double>(true_matches);
    state.counters["s/window"] = benchmark::Counter(static_cast<double>(asked), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void shaping(benchmark::State& state) {
    Shaper const shaper{base()};
    auto reader = shaper.reader();
    std::size_t individual = 0;
    auto const& lives = children().windows;
    for (auto _ : state) benchmark::DoNotOptimize(reader.shaping(lives[individual++ % lives.size()]));
}

bool const registered = [] {
    for (int i = 0; i <= static_cast<int>(detected_isa()); ++i) {
        Isa const isa = static_cast<Isa>(i);
        std::string const set{name(isa)};
        benchmark::RegisterBenchmark(("knowledge/build/exact/" + set).c_str(), build, exact, isa)->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("knowledge/query/exact/" + set).c_str(), query, exact, isa)->Unit(benchmark::kMicrosecond);
    }
    benchmark::RegisterBenchmark("knowledge/build/flann_4x128", build, flann_128, detected_isa())->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("knowledge/query/flann_4x32", query, flann_32, detected_isa())->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("knowledge/query/flann_4x128", query, flann_128, detected_isa())->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("knowledge/query/scan", query, scan, detected_isa())->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("knowledge/shaping/individual", shaping)->Unit(benchmark::kMicrosecond);
    return true;
}();

} // namespace

} // namespace lore
