#include "exact_kernel.h"
#include "exact_tables.h"
#include "pattern_cache.h"

#include <lore/knowledge/index.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>

// Three bounds let the exact index compute few distances. All follow from the configuration and the channels' kinds.
//
// 1. The squared distance is at least the number of differing bits, in float too: the sum of squares is not negative
//    and the number of bits is added last. So a match differs in at most D bits, D the largest number below the squared
//    threshold (3 for the paper's).
// 2. Cut the bits into D + 1 blocks: two windows that differ in at most D bits agree in at least one block. A hash
//    table per block finds all windows that agree in it ("multi-index hashing", Norouzi et al. 2012). Bit i belongs to
//    block i mod (D + 1): of many partitions tried this one leads to the fewest features, ten times fewer than blocks
//    of whole channels, which change seldom, or of neighboring steps. Blocks of a few bits select nothing; then one
//    bucket holds all features.
// 3. The sum of squares over n steps is at least n times the square of the means' difference. Sums of each channel over
//    each half, scaled and rounded to integers, bound the continuous part from below.
//
// Bound 3 is rounded three times, and the index leaves room for each: the distance in float is off by at most
// (C T / 16 + 10) 2^-24 of itself, C continuous channels; a sum of n values by n 2^-24 of n; the integers by a half
// each.
//
// While the set grows, which is when a knowledge base is built, a search may also use what it has found: buckets are
// visited from the smallest to the largest, and after k of them a feature that has not been seen differs in at least k
// bits, so that a match at a smaller distance ends the search; and bounds 1 and 3 shrink with the distance. Most of a
// bucket is passed over by bound 3 for sums over the whole window, which fit into 8 bytes together with the number of
// set bits.

namespace lore {

namespace exact {

static Kernel kernel_of(Isa isa) { return kernel_for(isa, LORE_KERNELS(kernel))(); }

}   // namespace exact

namespace {

using exact::Candidate;
using exact::Digest;
using exact::FixedView;
using exact::GrowingView;
using exact::PatternCache;
using exact::Query;

constexpr int fewest_block_bits = 12;   ///< a table of 2^12 slots still tells a KB of 24 000 features apart

int most_differing_bits(KnowledgeConfig const& config) {
    double const below = std::ceil(static_cast<double>(config.squared_threshold())) - 1;
    return static_cast<int>(std::clamp(below, 0.0, static_cast<double>(config.window_length) * binary_count));
}

/// For `numbers` sums over `steps` steps each. With x the distance of the sums before rounding and s what rounding can
/// add, the bound is (x + s)^2, which never exceeds (1 + e) x^2 + (1 + 1/e) s^2; with this e it is hardly looser.
exact::SumBound bound_of_sums(int steps, int numbers) {
    constexpr double e = 0.05;
    double const rounding = 0.5 + steps * 0x1p-15;   // of one number, sum and quantization
    double const slack = 2 * rounding * std::sqrt(static_cast<double>(numbers));
    double const scale = static_cast<double>(exact::summary_scale) * exact::summary_scale / steps;
    return {static_cast<float>((1 + e) * scale), static_cast<float>((1 + 1 / e) * slack * slack + 1)};
}

exact::Shape shape_of(KnowledgeConfig const& config) {
    exact::Shape shape{};
    int const bits = config.window_length * binary_count;
    shape.window_length = config.window_length;
    shape.words = (bits + 63) / 64;
    shape.first_half = (config.window_length + 1) / 2;
    int const halves[2]{shape.first_half, config.window_length - shape.first_half};
    for (int half = 0; half < 2; ++half)
        shape.scales[half] = halves[half] == 0
                                 ? 0.0f
                                 : static_cast<float>(exact::summary_scale /
                                                      std::sqrt(static_cast<double>(shape.first_half) * halves[half]));
    shape.most_differing = most_differing_bits(config);
    shape.tables = bits / (shape.most_differing + 1) >= fewest_block_bits ? shape.most_differing + 1 : 1;
    shape.squared_threshold = config.squared_threshold();
    shape.relative_error = static_cast<float>((continuous_count * config.window_length / 16.0 + 10) * 0x1p-23);
    shape.key_scale = static_cast<float>(exact::summary_scale) / static_cast<float>(config.window_length);
    shape.summary_bound = bound_of_sums(shape.first_half, exact::summary_size);
    shape.key_bound = bound_of_sums(config.window_length, exact::key_size);
    return shape;
}

std::vector<std::uint64_t> masks_of(exact::Shape const& shape) {
    std::vector<std::uint64_t> masks(static_cast<std::size_t>(shape.tables * shape.words), 0);
    bool const everything_in_one_chain = shape.tables != shape.most_differing + 1;
    if (everything_in_one_chain) return masks;
    for (int bit = 0; bit < shape.window_length * binary_count; ++bit)
        masks[static_cast<std::size_t>(bit % shape.tables * shape.words + bit / 64)] |= std::uint64_t{1} << (bit % 64);
    return masks;
}

/// limits[d]: the largest squared distance of two summaries whose windows match and differ in d bits.
std::vector<std::int32_t> limits_of(exact::Shape const& shape) {
    std::vector<std::int32_t> limits;
    for (int differing = 0; differing <= shape.most_differing; ++differing)
        limits.push_back(shape.summary_bound.largest(shape.squared_threshold * (1 + shape.relative_error) -
                                                     static_cast<float>(differing)));
    return limits;
}

class ExactIndex : public FeatureIndex {
public:
    explicit ExactIndex(KnowledgeConfig const& config)
        : shape_(shape_of(config)), masks_(masks_of(shape_)), limits_(limits_of(shape_)),
          kernel_(exact::kernel_of(active_isa())), records_(shape_.words),
          growing_(std::in_place, shape_.tables, masks_) {}

    void add(Window const& window) override;
    int size() const override { return static_cast<int>(records_.count()); }
    FeatureWindows release() override { return std::move(features_); }
    std::unique_ptr<FeatureSearch> search() const override;
    void set_values(std::span<double const> values) override {
        assert(values.size() == records_.count());
        worth_.assign(values.begin(), values.end());
        if (final()) return;
        growing_.reset();
        fixed_.emplace(shape_.tables, masks_, records_);
    }

    exact::Shape const& shape() const { return shape_; }
    exact::Kernel const& kernel() const { return kernel_; }
    /// What the features are worth; known once the set is final.
    std::span<double const> worth() const { return worth_; }
    bool final() const { return fixed_.has_value(); }
    /// Precondition: not final.
    GrowingView growing() const {
        return {shape_, growing_->view(), growing_->keys(), growing_->numbers(), records_[0], features_.values.data()};
    }
    std::size_t largest_bucket() const { return growing_->largest_bucket(); }
    /// Precondition: final.
    FixedView fixed() const {
        return {shape_, fixed_->view(), fixed_->records(), features_.values.data(), limits_.data()};
    }

private:
    exact::Shape shape_;
    std::vector<std::uint64_t> masks_;
    std::vector<std::int32_t> limits_;
    exact::Kernel kernel_;
    exact::Records records_;
    std::optional<exact::GrowingTables> growing_;   ///< until the set is final
    std::optional<exact::FixedTables> fixed_;       ///< from then on
    FeatureWindows features_;
    std::vector<double> worth_;
};

void ExactIndex::add(Window const& window) {
    assert(window.bits.size() == static_cast<std::size_t>(shape_.window_length) && !final());
    Digest digest{{}, size()};
    features_.add(window);
    std::uint64_t* const record = records_.add();
    kernel_.pack(shape_, window.bits.data(), record);
    exact::Key const key = kernel_.summarize_with_key(shape_, record, window.values.data(), digest);
    std::memcpy(record + shape_.words, &digest, sizeof digest);
    growing_->add(records_, key);
}

/// Windows of one run keep repeating the same patterns (85 of 100 in an evolved population), so the features within
/// reach of a pattern are remembered, from the moment when the set of features is final.
class ExactSearch : public FeatureSearch {
public:
    explicit ExactSearch(ExactIndex const& index)
        : index_(index), words_(static_cast<std::size_t>(index.shape().words)), cache_(index.shape().words) {}

    Match match(Window const& window) override {
        if (!index_.final()) return closest(window);
        return match(window, reachable(window.bits));
    }

    Match match_above(Window const& window, double least) override {
        std::span<Candidate const> const candidates = reachable(window.bits);
        // They are in falling order of worth. Is there any above `least` that may be near enough to matter?
        auto const end = std::partition_point(candidates.begin(), candidates.end(),
                                              [&](Candidate const& candidate) { return worth(candidate) > least; });
        if (end == candidates.begin()) return {};
        return match(window, candidates, static_cast<std::size_t>(end - candidates.begin()));
    }

    bool may_match_above(std::span<std::uint16_t const> bits, double least) override {
        std::span<Candidate const> const candidates = reachable(bits);
        return !candidates.empty() && worth(candidates.front()) > least;
    }

private:
    double worth(Candidate const& candidate) const {
        return index_.worth()[static_cast<std::size_t>(candidate.digest.feature)];
    }

    Match closest(Window const& window) {
        exact::Kernel const& kernel = index_.kernel();
        kernel.pack(index_.shape(), window.bits.data(), words_.data());
        Digest digest{};
        exact::Key const key = kernel.summarize_with_key(index_.shape(), words_.data(), window.values.data(), digest);
        visits_.resize(static_cast<std::size_t>(index_.shape().tables));
        std::size_t const room = index_.largest_bucket() + exact::spare_numbers;
        if (numbers_.size() < room) numbers_.resize(room * 2);
        return result(kernel.closest(index_.growing(), {words_.data(), window.values.data()}, digest, key,
                                     {visits_.data(), numbers_.data(), recent_.data()}));
    }

    /// All within reach of the bits, in falling order of worth.
    std::span<Candidate const> reachable(std::span<std::uint16_t const> bits) {
        assert(index_.final() && bits.size() == static_cast<std::size_t>(index_.shape().window_length));
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
        std::size_t const most =
            static_cast<std::size_t>(index_.size()) * static_cast<std::size_t>(index_.shape().tables) + 1;
        if (found_.size() < most) found_.resize(most * 2);
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

    static Match result(exact::Nearest const& nearest) {
        return nearest.feature < 0 ? Match{} : Match{nearest.feature, nearest.squared_distance};
    }

    ExactIndex const& index_;
    std::vector<std::uint64_t> words_;
    PatternCache cache_;
    std::vector<Candidate> found_, promising_;   // of the final set
    std::vector<exact::Visit> visits_;           // of the growing set, as is what follows
    std::vector<std::int32_t> numbers_;
    std::vector<std::int32_t> recent_ = std::vector<std::int32_t>(std::size_t{1} << exact::recent_bits, -1);
};

std::unique_ptr<FeatureSearch> ExactIndex::search() const { return std::make_unique<ExactSearch>(*this); }

}   // namespace

std::unique_ptr<FeatureIndex> make_exact_index(KnowledgeConfig const& config) {
    return std::make_unique<ExactIndex>(config);
}

}   // namespace lore
