#include <lore/knowledge/derive.h>

#include <lore/core/error.h>
#include <lore/core/random.h>
#include <lore/knowledge/index.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace lore {

namespace {

template <class T>
std::vector<T> copy_of(std::span<T const> items) {
    return {items.begin(), items.end()};
}

std::vector<int> features_where(KnowledgeBase const& base, auto const& holds) {
    std::vector<int> features;
    for (int i = 0; i < base.size(); ++i)
        if (holds(i)) features.push_back(i);
    return features;
}

Provenance derived(KnowledgeBase const& base, char const* kind, std::string what) {
    Provenance provenance = base.provenance();
    provenance.kind = kind;
    provenance.derivation.push_back(std::move(what));
    return provenance;
}

/// The evidence of some of the features.
EvidenceArrays evidence_of(Evidence const& all, std::vector<int> const& features, std::size_t before) {
    EvidenceArrays kept;
    auto const take = [&](auto& to, auto const& from) {
        for (std::size_t first = 0; first < from.size(); first += before)
            for (int const feature : features) to.push_back(from[first + static_cast<std::size_t>(feature)]);
    };
    kept.gammas = all.gammas;
    kept.has_credit = all.has_credit;
    kept.success_reward = all.success_reward;
    kept.successes = all.successes;
    kept.failures = all.failures;
    take(kept.showings, all.showings);
    take(kept.return_sums, all.return_sums);
    take(kept.news, all.news);
    take(kept.gain_sums, all.gain_sums);
    take(kept.successes_that_showed, all.successes_that_showed);
    take(kept.failures_that_showed, all.failures_that_showed);
    return kept;
}

KnowledgeBase keep(KnowledgeBase const& base, std::vector<int> const& features, std::string what) {
    KnowledgeArrays kept;
    for (int const feature : features) {
        Window const window = base.window(feature);
        kept.bits.insert(kept.bits.end(), window.bits.begin(), window.bits.end());
        kept.windows.insert(kept.windows.end(), window.values.begin(), window.values.end());
        kept.values.push_back(base.value(feature));
        kept.reward_sums.push_back(base.reward_sum(feature));
        kept.counts.push_back(base.count(feature));
    }
    kept.evidence = evidence_of(base.evidence(), features, static_cast<std::size_t>(base.size()));
    return KnowledgeBase{
        base.config(),
        derived(base, "reduced", fmt::format("{}: {} of {} features", what, features.size(), base.size())),
        std::move(kept)};
}

}   // namespace

KnowledgeBase randomize(KnowledgeBase const& base, std::uint64_t seed) {
    std::vector<double> values = copy_of(base.values());
    if (base.size() > 0) {
        auto const [low, high] = std::minmax_element(base.values().begin(), base.values().end());
        Stream rng{seed, Purpose::randomize};
        for (double& value : values) value = rng.uniform(*low, *high);
    }
    return base.with_values(std::move(values),
                            derived(base, "random", fmt::format("values drawn at random with seed {}", seed)));
}

KnowledgeBase permute(KnowledgeBase const& base, std::uint64_t seed) {
    std::vector<double> values = copy_of(base.values());
    Stream{seed, Purpose::permute}.shuffle(std::span{values});
    return base.with_values(std::move(values),
                            derived(base, "permuted", fmt::format("values shuffled with seed {}", seed)));
}

KnowledgeBase revalue(KnowledgeBase const& base, ValueConfig const& config) {
    KnowledgeBase const with_new = valued(base, config);
    std::string const& kind = base.provenance().kind;
    bool const untrue = kind == "random" || kind == "permuted";
    Provenance provenance = derived(with_new, untrue ? "revalued" : kind.c_str(),
                                    fmt::format("valued by rule {}", with_new.provenance().value));
    KnowledgeBase::Parts parts = with_new.parts();
    parts.provenance = std::move(provenance);
    return KnowledgeBase{std::move(parts)};
}

KnowledgeBase keep_top(KnowledgeBase const& base, int count) {
    std::vector<int> features(static_cast<std::size_t>(base.size()));
    std::iota(features.begin(), features.end(), 0);
    std::stable_sort(features.begin(), features.end(), [&](int a, int b) { return base.value(a) > base.value(b); });
    features.resize(std::min(features.size(), static_cast<std::size_t>(std::max(count, 0))));
    std::sort(features.begin(), features.end());
    return keep(base, features, fmt::format("top {}", count));
}

KnowledgeBase keep_valued(KnowledgeBase const& base, double least_value) {
    return keep(base, features_where(base, [&](int i) { return base.value(i) >= least_value; }),
                fmt::format("value at least {}", least_value));
}

KnowledgeBase keep_shown(KnowledgeBase const& base, int least_count) {
    return keep(base, features_where(base, [&](int i) { return std::cmp_greater_equal(base.count(i), least_count); }),
                fmt::format("shown by at least {}", least_count));
}

KnowledgeBase keep_consensus(KnowledgeBase const& base, std::span<KnowledgeBase const> others) {
    std::vector<int> features(static_cast<std::size_t>(base.size()));
    std::iota(features.begin(), features.end(), 0);
    for (KnowledgeBase const& other : others) {
        if (other.config().window_length != base.config().window_length)
            throw UsageError("the knowledge bases cannot be compared",
                             fmt::format("their windows have {} and {} steps", base.config().window_length,
                                         other.config().window_length),
                             "Build them with one window length.");
        if (std::string const reason = why_misfit(other.config().channels, base.config().channels); !reason.empty())
            throw UsageError("the knowledge bases cannot be compared", "one was " + reason,
                             "Take bases of worlds with the same channels.");
        auto const index = make_exact_index(base.config());
        for (int i = 0; i < other.size(); ++i) index->add(other.window(i));
        auto const search = index->search();
        std::erase_if(features, [&](int feature) { return !search->match(base.window(feature)).found(); });
    }
    return keep(base, features, fmt::format("consensus with {} more", others.size()));
}

}   // namespace lore
