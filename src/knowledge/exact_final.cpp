#include "exact_kernel.h"
#include "exact_shape.h"
#include "exact_tables.h"
#include "keyed_set.h"
#include "pattern_cache.h"

#include <lore/knowledge/index.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>

// exact_shape.h has the bounds. In a final set the features within reach of a pattern are remembered: windows of one
// run keep repeating the same patterns (85 of 100 in an evolved population).
//
// Where bits tell features not or hardly apart, as in a world whose channels are continuous, that does not help. Then
// the ranges of all groups of keys are read from the start to the end, and the keys of those that are near. Shares of
// keys lie in falling order of worth, so that a question for features above some worth reads the first of them alone;
// within a share, neighbors are alike.

namespace lore {

namespace {

using exact::Candidate;
using exact::Digest;
using exact::FixedView;
using exact::Key;
using exact::KeyedView;
using exact::PatternCache;
using exact::Query;

class ExactFinalIndex : public FeatureIndex {
public:
    explicit ExactFinalIndex(KnowledgeBase const&);

    int size() const override { return static_cast<int>(worth_.size()); }
    std::unique_ptr<FeatureSearch> search() const override;

    exact::Shape const& shape() const { return shape_; }
    exact::Kernel const& kernel() const { return kernel_; }
    /// What the features are worth.
    std::span<double const> worth() const { return worth_; }
    /// Whether it has ranked keys instead of tables.
    bool ranked() const { return !fixed_; }
    /// Precondition: ranked.
    KeyedView keyed() const { return {shape_, &ranked_view_, patterns_[0], codes_.data()}; }
    /// In falling order. Precondition: ranked.
    std::span<double const> falling_worth() const { return falling_worth_; }
    /// Records that a search looks at, at most. Precondition: not ranked.
    std::size_t most_visits() const { return fixed_->most_visits(); }
    /// Precondition: not ranked.
    FixedView fixed() const { return {shape_, fixed_->view(), fixed_->records(), values_, limits_.data()}; }
    /// [step][continuous channel]
    float const* values(std::int32_t feature) const { return values_ + static_cast<std::size_t>(feature) * floats_; }

private:
    /// Leaves no tables if they do not tell the features apart.
    void hash(KnowledgeBase const&);
    void rank(KnowledgeBase const&);

    exact::Shape shape_;
    std::size_t floats_;   ///< of a window
    std::vector<std::uint64_t> masks_;
    std::vector<std::int32_t> limits_;
    exact::Kernel kernel_;
    std::optional<exact::FixedTables> fixed_;   ///< or what follows
    exact::GroupedKeys ranked_;
    exact::KeyedTable ranked_view_{};
    std::vector<double> falling_worth_;
    exact::Records patterns_;
    PagedArray<std::uint8_t> codes_;
    float const* values_;   ///< of the base: [feature][step][continuous channel]
    std::span<double const> worth_;
};

ExactFinalIndex::ExactFinalIndex(KnowledgeBase const& base)
    : shape_(exact::shape_of(base.config())),
      floats_(static_cast<std::size_t>(shape_.window_length) * static_cast<std::size_t>(shape_.continuous)),
      masks_(exact::masks_of(shape_)), limits_(exact::limits_of(shape_)), kernel_(exact::kernel_of(active_isa())),
      patterns_(exact::pattern_room(shape_.words)), values_(base.parts().windows.data()), worth_(base.values()) {
    if (shape_.hashes) hash(base);
    if (!fixed_) rank(base);
}

void ExactFinalIndex::hash(KnowledgeBase const& base) {
    exact::Records records{exact::record_size(shape_.words)};
    for (int feature = 0; feature < base.size(); ++feature) {
        Window const window = base.window(feature);
        std::uint64_t* const record = records.add();
        Digest digest{{}, feature};
        kernel_.pack(shape_, window.bits.data(), record);
        kernel_.summarize(shape_, window.values.data(), digest);
        std::memcpy(record + shape_.words, &digest, sizeof digest);
    }
    fixed_.emplace(shape_.tables, masks_, records);
    if (fixed_->usual_visits() > static_cast<double>(base.size())) fixed_.reset();
}

void ExactFinalIndex::rank(KnowledgeBase const& base) {
    auto const bytes = static_cast<std::size_t>(shape_.code_size);
    codes_.resize(static_cast<std::size_t>(base.size()) * bytes);
    std::vector<Key> keys;
    keys.reserve(static_cast<std::size_t>(base.size()));
    for (int feature = 0; feature < base.size(); ++feature) {
        Window const window = base.window(feature);
        keys.push_back(kernel_.describe(shape_, window.bits.data(), window.values.data(), patterns_.add(),
                                        codes_.data() + static_cast<std::size_t>(feature) * bytes));
        keys.back().feature = feature;
    }
    auto const worth_of = [&](Key const& key) { return worth_[static_cast<std::size_t>(key.feature)]; };
    std::stable_sort(keys.begin(), keys.end(), [&](Key const& a, Key const& b) { return worth_of(a) > worth_of(b); });
    for (Key const& key : keys) falling_worth_.push_back(worth_of(key));
    ranked_.resize(keys.size());
    for (std::size_t first = 0; first < keys.size(); first += exact::keys_at_once) {
        auto const share =
            std::span{keys}.subspan(first, std::min<std::size_t>(exact::keys_at_once, keys.size() - first));
        exact::GroupedKeys::order(share);
        ranked_.put(first, share);
    }
    ranked_view_ = ranked_.view();
}

class ExactFinalSearch : public FeatureSearch {
public:
    explicit ExactFinalSearch(ExactFinalIndex const& index)
        : index_(index), words_(static_cast<std::size_t>(index.shape().words)), cache_(index.shape().words),
          asked_(index.shape()) {
        asked_.resize(1);
    }

    Match match(Window const& window) override {
        if (index_.ranked()) return closest_ranked(window, index_.worth().size());
        return match(window, reachable(window.bits));
    }

    Match match_above(Window const& window, double least) override {
        if (index_.ranked()) return closest_ranked(window, worth_more(least));
        std::span<Candidate const> const candidates = reachable(window.bits);
        // They are in falling order of worth. Is there any above `least` that may be near enough to matter?
        auto const end = std::partition_point(candidates.begin(), candidates.end(),
                                              [&](Candidate const& candidate) { return worth(candidate) > least; });
        if (end == candidates.begin()) return {};
        return match(window, candidates, static_cast<std::size_t>(end - candidates.begin()));
    }

    bool may_match_above(std::span<std::uint16_t const> bits, double least) override {
        if (index_.ranked()) {
            index_.kernel().pack(index_.shape(), bits.data(), words_.data());
            return index_.kernel().any_within(index_.keyed(), words_.data(),
                                              {0, static_cast<std::uint32_t>(worth_more(least))});
        }
        std::span<Candidate const> const candidates = reachable(bits);
        return !candidates.empty() && worth(candidates.front()) > least;
    }

private:
    double worth(Candidate const& candidate) const {
        return index_.worth()[static_cast<std::size_t>(candidate.digest.feature)];
    }

    /// How many of a ranked set, from the first, are in shares of which some are worth more.
    std::size_t worth_more(double least) const {
        std::span<double const> const worth = index_.falling_worth();
        auto const end = std::partition_point(worth.begin(), worth.end(), [&](double one) { return one > least; });
        auto const more = static_cast<std::size_t>(end - worth.begin());
        return std::min((more + exact::keys_at_once - 1) / exact::keys_at_once * exact::keys_at_once, worth.size());
    }

    /// The nearest of a ranked set, unless none of the first `first` is a match.
    Match closest_ranked(Window const& window, std::size_t first) {
        if (first == 0) return {};
        asked_.describe(0, index_.kernel(), window);
        Match const of_first = closest_among(window, 0, first, index_.shape().squared_threshold);
        if (!of_first.found()) return {};
        Match const of_rest = closest_among(window, first, index_.worth().size(), of_first.squared_distance);
        bool const nearer =
            of_rest.squared_distance < of_first.squared_distance ||
            (of_rest.squared_distance == of_first.squared_distance && of_rest.feature < of_first.feature);
        return nearer ? of_rest : of_first;
    }

    Match closest_among(Window const& window, std::size_t from, std::size_t to, float bound) {
        exact::Bucket const places{static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)};
        exact::Search search{asked_[0],
                             {bound, exact::all_features},
                             memory_.room_for(index_.shape(), index_.worth().size(), nullptr),
                             0};
        index_.kernel().closest_among(index_.keyed(), search, places);
        return nearest_of(memory_.finalists(search), index_.kernel(), index_.shape(), window.values.data(),
                          [&](std::int32_t feature) { return index_.values(feature); });
    }

    /// All within reach of the bits, in falling order of worth.
    std::span<Candidate const> reachable(std::span<std::uint16_t const> bits) {
        assert(bits.size() == static_cast<std::size_t>(index_.shape().window_length * index_.shape().step_words));
        index_.kernel().pack(index_.shape(), bits.data(), words_.data());
        if (PatternCache::List const* const known = cache_.find(words_.data())) return cache_.candidates(*known);
        std::span<Candidate> found = look_up();
        std::sort(found.begin(), found.end(), [&](Candidate const& a, Candidate const& b) {
            double const a_worth = worth(a), b_worth = worth(b);
            return a_worth != b_worth ? a_worth > b_worth : a.digest.feature < b.digest.feature;
        });
        auto const end = std::unique(found.begin(), found.end(), [](Candidate const& a, Candidate const& b) {
            return a.digest.feature == b.digest.feature;
        });
        return cache_.add(words_.data(), found.first(static_cast<std::size_t>(end - found.begin())));
    }

    std::span<Candidate> look_up() {
        if (std::size_t const room = index_.most_visits() + 1; found_.size() < room) found_.resize(room);
        return {found_.data(),
                static_cast<std::size_t>(index_.kernel().within(index_.fixed(), words_.data(), found_.data()))};
    }

    /// The nearest, unless none of the first `first` is promising.
    Match match(Window const& window, std::span<Candidate const> candidates, std::size_t first = 0) {
        if (candidates.empty()) return {};
        FixedView const view = index_.fixed();
        exact::Kernel const& kernel = index_.kernel();
        Digest digest{};
        kernel.summarize(index_.shape(), window.values.data(), digest);
        if (promising_.size() <= candidates.size()) promising_.resize(candidates.size() * 2);
        int kept = kernel.promising(view, digest, candidates.data(), static_cast<int>(first), promising_.data());
        if (first > 0 && kept == 0) return {};
        auto const rest = candidates.subspan(first);
        kept += kernel.promising(view, digest, rest.data(), static_cast<int>(rest.size()), promising_.data() + kept);
        Query const query{words_.data(), window.values.data()};
        exact::Nearest const nearest = kernel.nearest(view, query, promising_.data(), kept);
        return nearest.feature < 0 ? Match{} : Match{nearest.feature, nearest.squared_distance};
    }

    ExactFinalIndex const& index_;
    std::vector<std::uint64_t> words_;
    PatternCache cache_;
    std::vector<Candidate> found_, promising_;   // of a set with tables
    exact::Descriptions asked_;                  // of a ranked one, as is what follows
    exact::SearchMemory memory_;
};

std::unique_ptr<FeatureSearch> ExactFinalIndex::search() const { return std::make_unique<ExactFinalSearch>(*this); }

}   // namespace

std::unique_ptr<FeatureIndex> make_final_exact_index(KnowledgeBase const& base) {
    return std::make_unique<ExactFinalIndex>(base);
}

}   // namespace lore
