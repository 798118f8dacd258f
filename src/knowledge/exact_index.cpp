#include "exact_kernel.h"
#include "exact_shape.h"
#include "exact_tables.h"
#include "pattern_cache.h"

#include <lore/knowledge/index.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>

// exact_shape.h has the bounds. How they are used depends on the set.
//
// While it grows, which is when a knowledge base is built, a search may use what it has found: buckets are visited from
// the smallest to the largest, those of halves before those of blocks. The more have been seen, the more bits must
// differ in a feature that has not (KeyedSearch): a match at a smaller distance ends the search, and these bits leave
// less for the continuous channels. Bounds 1 and 3 shrink with the distance, too. Most of a bucket is passed over by
// keys: bound 3 for sums over all steps, which fit into 8 bytes together with the number of set bits.
//
// In a final set the features within reach of a pattern are remembered: windows of one run keep repeating the same
// patterns (85 of 100 in an evolved population).
//
// Where bits tell features not or hardly apart, as in a world whose channels are continuous, neither helps. Then all
// keys are read from the start to the end, which takes a nanosecond each or less. Once the set is final they lie in
// falling order of worth, so that a question for features above some worth reads the first of them alone.

namespace lore {

namespace exact {

static Kernel kernel_of(Isa isa) { return kernel_for(isa, LORE_KERNELS(kernel))(); }

}   // namespace exact

namespace {

using exact::Candidate;
using exact::Digest;
using exact::FixedView;
using exact::Key;
using exact::KeyedView;
using exact::Nearest;
using exact::PatternCache;
using exact::Query;

class ExactIndex : public FeatureIndex {
public:
    /// Empty, to be added to.
    explicit ExactIndex(KnowledgeConfig const& config) : ExactIndex(config, nullptr) {
        growing_.emplace(exact::growing_tables(shape_), exact::growing_masks_of(shape_));
    }
    /// Final.
    explicit ExactIndex(KnowledgeBase const&);

    void add(Window const& window) override;
    int size() const override { return static_cast<int>(records_.count()); }
    FeatureWindows release() override { return std::move(features_); }
    std::unique_ptr<FeatureSearch> search() const override;
    void set_values(std::span<double const>) override;

    exact::Shape const& shape() const { return shape_; }
    exact::Kernel const& kernel() const { return kernel_; }
    /// What the features are worth; known once the set is final.
    std::span<double const> worth() const { return worth_; }
    bool final() const { return !growing_; }
    /// Whether a final set has ranked keys instead of tables.
    bool ranked() const { return ranked_.has_value(); }
    /// Precondition: not final, or ranked.
    KeyedView keyed() const {
        return ranked_
                   ? KeyedView{shape_, {}, ranked_->keys(), ranked_->numbers(), records_[0], values()}
                   : KeyedView{shape_, growing_->view(), growing_->keys(), growing_->numbers(), records_[0], values()};
    }
    /// Records that a search looks at, at most. Precondition: final and not ranked.
    std::size_t most_visits() const { return fixed_->most_visits(); }
    std::size_t largest_bucket() const { return ranked_ ? records_.count() : growing_->largest_bucket(); }
    /// Precondition: ranked.
    std::int32_t const* ranks() const { return ranked_->numbers(); }
    /// Precondition: final and not ranked.
    FixedView fixed() const { return {shape_, fixed_->view(), fixed_->records(), values(), limits_.data()}; }

private:
    ExactIndex(KnowledgeConfig const& config, float const* base_values)
        : channels_(config.channels), shape_(exact::shape_of(config)), masks_(exact::masks_of(shape_)),
          limits_(exact::limits_of(shape_)), kernel_(exact::kernel_of(active_isa())), records_(shape_.words),
          base_values_(base_values) {}

    /// [feature][step][continuous channel]
    float const* values() const { return base_values_ != nullptr ? base_values_ : features_.values.data(); }
    /// Keeps the record of the next feature; returns its key.
    Key add_record(Window const&);
    void hash();
    void rank();

    Channels channels_;
    exact::Shape shape_;
    std::vector<std::uint64_t> masks_;
    std::vector<std::int32_t> limits_;
    exact::Kernel kernel_;
    exact::Records records_;
    std::optional<exact::GrowingTables> growing_;   ///< until the set is final
    std::optional<exact::FixedTables> fixed_;       ///< from then on, or
    std::optional<exact::RankedKeys> ranked_;
    float const* base_values_;   ///< of the base that it was made of, else null
    FeatureWindows features_;    ///< those that were added
    std::vector<double> worth_;
};

ExactIndex::ExactIndex(KnowledgeBase const& base) : ExactIndex(base.config(), base.parts().windows.data()) {
    records_.reserve(static_cast<std::size_t>(base.size()));
    for (int feature = 0; feature < base.size(); ++feature) add_record(base.window(feature));
    hash();
    set_values(base.values());
}

void ExactIndex::add(Window const& window) {
    assert(window.bits.size() == static_cast<std::size_t>(shape_.window_length * shape_.step_words));
    assert(window.values.size() == static_cast<std::size_t>(shape_.window_length * shape_.continuous) && !final());
    features_.add(channels_, window);
    Key const key = add_record(window);
    growing_->add(records_, key);
}

Key ExactIndex::add_record(Window const& window) {
    Digest digest{{}, size()};
    std::uint64_t* const record = records_.add();
    kernel_.pack(shape_, window.bits.data(), record);
    Key const key = kernel_.summarize_with_key(shape_, record, window.values.data(), digest);
    std::memcpy(record + shape_.words, &digest, sizeof digest);
    return key;
}

void ExactIndex::set_values(std::span<double const> values) {
    assert(values.size() == records_.count());
    worth_.assign(values.begin(), values.end());
    if (!final()) {
        growing_.reset();
        hash();
    }
    if (!fixed_) rank();
}

/// Tables of the final set, unless they tell its features not apart.
void ExactIndex::hash() {
    if (shape_.hashes) fixed_.emplace(shape_.tables, masks_, records_);
    bool const tells_apart = fixed_ && fixed_->usual_visits() <= static_cast<double>(records_.count());
    if (!tells_apart) fixed_.reset();
}

void ExactIndex::rank() {
    std::vector<Key> keys;
    keys.reserve(records_.count());
    auto const floats = static_cast<std::size_t>(shape_.window_length * shape_.continuous);
    for (std::size_t feature = 0; feature < records_.count(); ++feature) {
        Digest unused;
        keys.push_back(kernel_.summarize_with_key(shape_, records_[feature], values() + feature * floats, unused));
    }
    ranked_.emplace(keys, worth_);
}

class ExactSearch : public FeatureSearch {
public:
    explicit ExactSearch(ExactIndex const& index)
        : index_(index), words_(static_cast<std::size_t>(index.shape().words)), cache_(index.shape().words) {}

    Match match(Window const& window) override {
        if (!index_.final()) return closest(window);
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

    /// How many of a ranked set, from the first, are worth more.
    std::size_t worth_more(double least) const {
        std::span<double const> const worth = index_.worth();
        std::int32_t const* const ranks = index_.ranks();
        return static_cast<std::size_t>(std::partition_point(ranks, ranks + worth.size(),
                                                             [&](std::int32_t feature) {
                                                                 return worth[static_cast<std::size_t>(feature)] >
                                                                        least;
                                                             }) -
                                        ranks);
    }

    /// Fills in words_ and digest_ and returns the key.
    Key read(Window const& window) {
        exact::Kernel const& kernel = index_.kernel();
        kernel.pack(index_.shape(), window.bits.data(), words_.data());
        std::size_t const room = index_.largest_bucket() + exact::spare_numbers;
        if (numbers_.size() < room) {
            numbers_.resize(room * 2);
            sifted_.resize(room * 2);
        }
        return kernel.summarize_with_key(index_.shape(), words_.data(), window.values.data(), digest_);
    }

    Match closest(Window const& window) {
        Key const key = read(window);
        visits_.resize(static_cast<std::size_t>(exact::growing_tables(index_.shape())));
        return result(index_.kernel().closest(index_.keyed(), {words_.data(), window.values.data()}, digest_, key,
                                              {visits_.data(), numbers_.data(), recent_.data(), sifted_.data()}));
    }

    /// The nearest of a ranked set, unless none of the first `first` is a match.
    Match closest_ranked(Window const& window, std::size_t first) {
        if (first == 0) return {};
        Key const key = read(window);
        auto const among = [&](std::size_t from, std::size_t to, Nearest const& best) {
            return index_.kernel().closest_among(
                index_.keyed(), {words_.data(), window.values.data()}, digest_, key,
                {nullptr, numbers_.data(), nullptr, sifted_.data()},
                {static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)}, best);
        };
        Nearest const best = among(0, first, {-1, index_.shape().squared_threshold});
        return result(best.feature < 0 ? best : among(first, index_.worth().size(), best));
    }

    /// All within reach of the bits, in falling order of worth.
    std::span<Candidate const> reachable(std::span<std::uint16_t const> bits) {
        assert(index_.final() &&
               bits.size() == static_cast<std::size_t>(index_.shape().window_length * index_.shape().step_words));
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
        return result(kernel.nearest(view, query, promising_.data(), kept));
    }

    static Match result(Nearest const& nearest) {
        return nearest.feature < 0 ? Match{} : Match{nearest.feature, nearest.squared_distance};
    }

    ExactIndex const& index_;
    std::vector<std::uint64_t> words_;
    PatternCache cache_;
    std::vector<Candidate> found_, promising_;   // of a final set with tables
    Digest digest_{};                            // of a set with keys, as is what follows
    std::vector<exact::Visit> visits_;
    std::vector<std::int32_t> numbers_;
    std::vector<exact::Promising> sifted_;
    std::vector<std::int32_t> recent_ = std::vector<std::int32_t>(std::size_t{1} << exact::recent_bits, -1);
};

std::unique_ptr<FeatureSearch> ExactIndex::search() const { return std::make_unique<ExactSearch>(*this); }

}   // namespace

std::unique_ptr<FeatureIndex> make_exact_index(KnowledgeConfig const& config) {
    return std::make_unique<ExactIndex>(config);
}

std::unique_ptr<FeatureIndex> make_final_exact_index(KnowledgeBase const& base) {
    return std::make_unique<ExactIndex>(base);
}

}   // namespace lore
