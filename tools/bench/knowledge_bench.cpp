// Knowledge: building a base of about 24 000 features from 120 000 windows, and asking it for the nearest feature: the
// exact index beside the scan that defines it and FLANN's forest. `window` is the time of one window.
//
// Questions are the windows of one generation's children, in a target run that the base shapes. `exact` is asked by a
// search that has answered for their parents before, as in a run; `exact_cold` by one that has just been made.
//
// `continuous` asks a base whose channels are all continuous: eight smooth ones, 24 000 features, half of the questions
// match. `growing` is the exact index as a build asks it, `final` as evaluation does.
#include "evolved_state.h"
#include "learned_base.h"
#include "smooth_base.h"

#include <lore/core/isa.h>
#include <lore/knowledge/shaping.h>

#include <benchmark/benchmark.h>

#include <string>

namespace lore {

namespace {

using Maker = std::unique_ptr<GrowingIndex> (*)();

std::unique_ptr<GrowingIndex> scan() { return make_scan_index(usual_windows()); }
std::unique_ptr<GrowingIndex> exact() { return make_exact_index(usual_windows()); }
std::unique_ptr<GrowingIndex> flann_32() { return make_flann_index(usual_windows(), 4, 32); }
std::unique_ptr<GrowingIndex> flann_128() { return make_flann_index(usual_windows(), 4, 128); }

/// Of the last joint pool of the target run: the parents, or the children.
Recordings lives_of_half(std::size_t half) {
    EvolvedState const& evolved = evolved_with_knowledge();
    std::vector<Birth const*> births;
    std::size_t const size = evolved.pool.size() / 2;
    for (std::size_t i = half * size; i < (half + 1) * size; ++i) births.push_back(evolved.pool[i].birth.get());
    return {*evolved.context.world, evolved.context.episode, births};
}
Recordings const& parents() {
    static Recordings const lives = lives_of_half(0);
    return lives;
}
Recordings const& children() {
    static Recordings const lives = lives_of_half(1);
    return lives;
}

std::vector<Window> every(std::size_t stride, Recordings const& lives) {
    std::vector<Window> windows;
    std::size_t number = 0;
    for (auto const& of_one : lives.windows)
        for (Window const& window : of_one)
            if (number++ % stride == 0) windows.push_back(window);
    return windows;
}

void count_windows(benchmark::State& state, std::size_t windows) {
    // The inverse of a rate is shown as the time of one.
    state.counters["window"] = benchmark::Counter(
        static_cast<double>(windows), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void build(benchmark::State& state, Maker make, Isa isa) {
    Isa const before = active_isa();
    use_isa(isa);
    teachers();
    int features = 0;
    for (auto _ : state) features = build_base(usual_teachers, make()).size();
    use_isa(before);
    state.counters["features"] = features;
    count_windows(state, usual_teachers * teachers().windows[0].size());
}

struct Asking {
    std::size_t stride = 1;   ///< every how manyth window is asked for: slow indices answer fewer
    bool warm = false;
    int teachers = usual_teachers;
};

void query(benchmark::State& state, Maker make, Isa isa, Asking asking) {
    Isa const before = active_isa();
    use_isa(isa);
    std::vector<Window> const questions = every(asking.stride, children()), earlier = every(asking.stride, parents());
    KnowledgeBase const base =
        asking.teachers == usual_teachers ? learned_base() : build_base(asking.teachers, exact());
    auto const filled = [&](std::unique_ptr<GrowingIndex> index) {
        for (int feature = 0; feature < base.size(); ++feature) index->add(base.window(feature));
        return index;
    };
    auto const index = filled(make());
    std::size_t found = 0;
    for (auto _ : state) {
        state.PauseTiming();
        auto const search = index->search();
        if (asking.warm)
            for (Window const& window : earlier) benchmark::DoNotOptimize(search->match(window));
        found = 0;
        state.ResumeTiming();
        for (Window const& window : questions) found += search->match(window).found();
    }

    auto const truth_index = filled(exact());
    auto const truth = truth_index->search();
    std::size_t true_matches = 0;
    for (Window const& window : questions) true_matches += truth->match(window).found();
    use_isa(before);
    state.counters["features"] = base.size();
    state.counters["recall"] = static_cast<double>(found) / static_cast<double>(true_matches);
    count_windows(state, questions.size());
}

/// What evaluation asks: only for features worth more than the best so far.
void shaping(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        Shaper const shaper{learned_base()};
        auto reader = shaper.reader();
        for (auto const& windows : parents().windows) benchmark::DoNotOptimize(reader.shaping(windows));
        state.ResumeTiming();
        for (auto const& windows : children().windows) benchmark::DoNotOptimize(reader.shaping(windows));
    }
    count_windows(state, children().windows.size() * children().windows[0].size());
}

using IndexMaker = std::unique_ptr<GrowingIndex> (*)(KnowledgeConfig const&);

template <int checks>
std::unique_ptr<GrowingIndex> flann_for(KnowledgeConfig const& config) {
    return make_flann_index(config, 4, checks);
}

std::unique_ptr<FeatureIndex> filled(std::unique_ptr<GrowingIndex> index) {
    for (Window const& window : smooth_base().known) index->add(window);
    return index;
}

template <IndexMaker make>
std::unique_ptr<FeatureIndex> growing() {
    return filled(make(smooth_base().config));
}

std::unique_ptr<FeatureIndex> exact_growing() { return filled(make_exact_index(smooth_base().config)); }

std::unique_ptr<FeatureIndex> exact_final() {
    SmoothBase const& smooth = smooth_base();
    static KnowledgeBase const base = [&] {
        FeatureWindows features;
        for (Window const& window : smooth.known) features.add(smooth.config.channels, window);
        std::vector<double> const worth(smooth.known.size(), 1.0);
        return KnowledgeBase{
            smooth.config,
            {},
            {features.bits, features.values, worth, worth, std::vector<std::uint32_t>(worth.size(), 1)}};
    }();
    return make_final_exact_index(base);
}

void continuous(benchmark::State& state, std::unique_ptr<FeatureIndex> (*make)(), std::size_t stride) {
    SmoothBase const& base = smooth_base();
    auto const index = make(), truth_index = exact_growing();
    auto const search = index->search(), truth = truth_index->search();
    std::vector<Window> questions;
    for (std::size_t i = 0; i < base.asked.size(); i += stride) questions.push_back(base.asked[i]);
    std::size_t found = 0, true_matches = 0;
    for (auto _ : state) {
        found = 0;
        for (Window const& window : questions) found += search->match(window).found();
    }
    for (Window const& window : questions) true_matches += truth->match(window).found();
    state.counters["features"] = static_cast<double>(base.known.size());
    state.counters["recall"] = static_cast<double>(found) / static_cast<double>(true_matches);
    count_windows(state, questions.size());
}

void register_continuous() {
    struct Case {
        char const* name;
        std::unique_ptr<FeatureIndex> (*make)();
        std::size_t stride;
    };
    for (Case const& one : {Case{"exact_growing", exact_growing, 1},
                            {"exact_final", exact_final, 1},
                            {"flann_4x32", growing<flann_for<32>>, 4},
                            {"flann_4x128", growing<flann_for<128>>, 4},
                            {"flann_4x512", growing<flann_for<512>>, 4},
                            {"scan", growing<make_scan_index>, 100}})
        benchmark::RegisterBenchmark(("knowledge/continuous/" + std::string{one.name}).c_str(), continuous, one.make,
                                     one.stride)
            ->Unit(benchmark::kMillisecond);
}

bool const registered = [] {
    Isa const best = detected_isa();
    for (int i = 0; i <= static_cast<int>(best); ++i) {
        Isa const isa = static_cast<Isa>(i);
        std::string const set{name(isa)};
        benchmark::RegisterBenchmark(("knowledge/build/exact/" + set).c_str(), build, exact, isa)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("knowledge/query/exact/" + set).c_str(), query, exact, isa, Asking{1, true})
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("knowledge/query/exact_cold/" + set).c_str(), query, exact, isa, Asking{})
            ->Unit(benchmark::kMillisecond);
    }
    for (int individuals : {75, 150, 300, 900})
        benchmark::RegisterBenchmark(
            ("knowledge/query/exact_of_" + std::to_string(individuals) + "_individuals").c_str(), query, exact, best,
            Asking{1, true, individuals})
            ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("knowledge/build/flann_4x128", build, flann_128, best)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
    benchmark::RegisterBenchmark("knowledge/query/flann_4x32", query, flann_32, best, Asking{50})
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("knowledge/query/flann_4x128", query, flann_128, best, Asking{50})
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("knowledge/query/scan", query, scan, best, Asking{2000})
        ->Unit(benchmark::kMillisecond);
    register_continuous();
    benchmark::RegisterBenchmark("knowledge/shaping", shaping)->Unit(benchmark::kMillisecond);
    return true;
}();

}   // namespace

}   // namespace lore
