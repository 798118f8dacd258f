#include "exact_hash.h"
#include "exact_kernel.h"
#include "pattern_cache.h"

#include <lore/core/isa.h>
#include <lore/knowledge/index.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

// Three bounds let the exact index compute few distances. All follow from the configuration and the channels' kinds.
//
// 1. The squared distance is at least the number of differing bits, in float too: the sum of squares is not negative
//    and the number of bits is added last. So a match differs in at most D bits, D the largest number below the squared
//    threshold (3 for the paper's).
// 2. Cut the bits into D + 1 blocks: two windows that differ in at most D bits agree in at least one block. A hash
//    table per block finds all who agree in it ("multi-index hashing", Norouzi et al. 2012). Bit i belongs to block
//    i mod (D + 1): of many partitions tried this one leads to the fewest features, ten times fewer than blocks of
//    whole channels, which change seldom, or of neighbouring steps. Blocks of a few bits select nothing; then one
//    bucket holds all features.
// 3. The sum of squares over n steps is at least n times the square of the means' difference. Sums of each channel over
//    each half, scaled and rounded to integers, bound the continuous part from below.
//
// Bound 3 is rounded three times, and `limits` leaves room for each: the distance in float is off by at most
// (6 T / 16 + 10) 2^-24 of itself; a sum of n values by n 2^-24 of n; the integers by a half each.

namespace lore {

namespace {

using exact::Candidate;
using exact::PatternCache;
using exact::Query;
using exact::View;

using exact::Digest;

constexpr int fewest_block_bits = 12;   ///< a table of 2^12 slots still tells a KB of 24 000 features apart

int most_differing_bits(KnowledgeConfig const& config) {
    double const below = std::ceil(static_cast<double>(config.squared_threshold())) - 1;
    return static_cast<int>(std::clamp(below, 0.0, static_cast<double>(config.window_length) * binary_count));
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
    double const relative_error = (continuous_count * shape.window_length / 16.0 + 10) * 0x1p-23;
    double const rounding = 0.5 + shape.first_half * 0x1p-15;   // of one number of a summary, sum and quantisation
    double const slack = 2 * rounding * std::sqrt(static_cast<double>(exact::summary_size));
    std::vector<std::int32_t> limits;
    for (int differing = 0; differing <= shape.most_differing; ++differing) {
        double const left =
            std::max(0.0, static_cast<double>(shape.squared_threshold) * (1 + relative_error) - differing);
        double const radius = exact::summary_scale * std::sqrt(left / shape.first_half) + slack;
        limits.push_back(static_cast<std::int32_t>(std::min(radius * radius + 1, 2147483647.0)));
    }
    return limits;
}

exact::Kernel kernel_of(Isa isa) {
#if LORE_ISA_COUNT > 1
    if (isa == Isa::v4) return exact::isa_v4::kernel();
    if (isa == Isa::v3) return exact::isa_v3::kernel();
#else
    (void)isa;
#endif
    return exact::isa_baseline::kernel();
}

class ExactIndex : public FeatureIndex {
public:
    explicit ExactIndex(KnowledgeConfig const& config)
        : shape_(shape_of(config)), entry_size_(static_cast<std::size_t>(exact::entry_size(shape_.words))),
          masks_(masks_of(shape_)), limits_(limits_of(shape_)), kernel_(kernel_of(active_isa())) {
        buckets_.assign(static_cast<std::size_t>(shape_.tables) << slot_bits_, {0, 0});
    }

    void add(Window const& window) override;
    int size() const override { return size_; }
    FeatureWindows release() override { return std::move(features_); }
    std::unique_ptr<FeatureSearch> search() const override;
    void set_values(std::span<double const> values) override {
        assert(values.size() == static_cast<std::size_t>(size_));
        worth_.assign(values.begin(), values.end());
        final_ = true;
    }

    exact::Shape const& shape() const { return shape_; }
    exact::Kernel const& kernel() const { return kernel_; }
    /// What the features are worth; known once the set is final.
    std::span<double const> worth() const { return worth_; }
    bool final() const { return final_; }
    View view() const {
        return {shape_,          masks_.data(),           buckets_.data(), slot_bits_,
                entries_.data(), features_.values.data(), limits_.data()};
    }

private:
    /// The bucket of one table that a pattern belongs to.
    exact::Bucket& bucket_of(int table, std::uint64_t const* words) {
        std::uint64_t const slot =
            exact::hash_slot(words, masks_.data() + table * shape_.words, shape_.words, slot_bits_);
        return buckets_[(static_cast<std::size_t>(table) << slot_bits_) + slot];
    }
    void insert(int table, std::uint64_t const* entry);
    void double_slots();

    exact::Shape shape_;
    std::size_t entry_size_;
    std::vector<std::uint64_t> masks_;
    std::vector<std::int32_t> limits_;
    exact::Kernel kernel_;
    int slot_bits_ = 8;                        ///< always at least as many slots as features
    std::vector<exact::Bucket> buckets_;
    std::vector<std::uint64_t> entries_;
    FeatureWindows features_;
    std::vector<double> worth_;
    bool final_ = false;
    int size_ = 0;
};

void ExactIndex::add(Window const& window) {
    assert(window.bits.size() == static_cast<std::size_t>(shape_.window_length) && !final());
    features_.add(window);
    std::vector<std::uint64_t> entry(entry_size_);
    kernel_.pack(shape_, window.bits.data(), entry.data());
    Digest digest{{}, size_};
    kernel_.summarize(shape_, window.values.data(), digest);
    std::memcpy(entry.data() + shape_.words, &digest, sizeof digest);
    if (static_cast<std::size_t>(++size_) > std::size_t{1} << slot_bits_) double_slots();
    for (int table = 0; table < shape_.tables; ++table) insert(table, entry.data());
}

/// A bucket has room for as many entries as the next power of two; where that is full, it moves to the end of entries_.
/// The places left behind are as many as those in use at most, until double_slots() clears them away.
void ExactIndex::insert(int table, std::uint64_t const* entry) {
    exact::Bucket& bucket = bucket_of(table, entry);
    if (std::has_single_bit(bucket.count) || bucket.count == 0) {
        std::size_t const room = std::max<std::size_t>(1, std::size_t{bucket.count} * 2);
        std::size_t const start = entries_.size() / entry_size_;
        entries_.resize(entries_.size() + room * entry_size_);
        std::copy_n(entries_.data() + bucket.start * entry_size_, bucket.count * entry_size_,
                    entries_.data() + start * entry_size_);
        bucket.start = static_cast<std::uint32_t>(start);
    }
    std::copy_n(entry, entry_size_, entries_.data() + (bucket.start + bucket.count) * entry_size_);
    ++bucket.count;
}

void ExactIndex::double_slots() {
    auto const old_buckets = std::move(buckets_);
    auto const old_entries = std::move(entries_);
    std::size_t const old_slots = std::size_t{1} << slot_bits_;
    ++slot_bits_;
    buckets_.assign(static_cast<std::size_t>(shape_.tables) << slot_bits_, {0, 0});
    entries_.clear();
    for (std::size_t i = 0; i < old_buckets.size(); ++i)
        for (std::uint32_t k = 0; k < old_buckets[i].count; ++k)
            insert(static_cast<int>(i / old_slots), old_entries.data() + (old_buckets[i].start + k) * entry_size_);
}

/// Windows of one run keep repeating the same patterns (85 of 100 in an evolved population), so the features within
/// reach of a pattern are remembered, from the moment when the set of features is final.
class ExactSearch : public FeatureSearch {
public:
    explicit ExactSearch(ExactIndex const& index)
        : index_(index), words_(static_cast<std::size_t>(index.shape().words)), cache_(index.shape().words) {}

    Match match(Window const& window) override {
        View const view = index_.view();
        return match(view, window, reachable(view, window.bits));
    }

    Match match_above(Window const& window, double least) override {
        View const view = index_.view();
        std::span<Candidate const> const candidates = reachable(view, window.bits);
        // They are in falling order of worth. Is there any above `least` that may be near enough to matter?
        auto const end = std::partition_point(candidates.begin(), candidates.end(),
                                              [&](Candidate const& candidate) { return worth(candidate) > least; });
        if (end == candidates.begin()) return {};
        return match(view, window, candidates, static_cast<std::size_t>(end - candidates.begin()));
    }

    bool may_match_above(std::span<std::uint16_t const> bits, double least) override {
        std::span<Candidate const> const candidates = reachable(index_.view(), bits);
        return !candidates.empty() && worth(candidates.front()) > least;
    }

private:
    double worth(Candidate const& candidate) const {
        return index_.worth()[static_cast<std::size_t>(candidate.digest.feature)];
    }

    /// All within reach of the bits; once the set is final, in falling order of worth.
    std::span<Candidate const> reachable(View const& view, std::span<std::uint16_t const> bits) {
        assert(bits.size() == static_cast<std::size_t>(index_.shape().window_length));
        index_.kernel().pack(index_.shape(), bits.data(), words_.data());
        if (!index_.final()) return look_up(view);
        if (PatternCache::List const* const known = cache_.find(words_.data())) return cache_.candidates(*known);
        std::span<Candidate> found = look_up(view);
        std::sort(found.begin(), found.end(), [&](Candidate const& a, Candidate const& b) {
            double const a_worth = worth(a), b_worth = worth(b);
            return a_worth != b_worth ? a_worth > b_worth : a.digest.feature < b.digest.feature;
        });
        auto const end = std::unique(found.begin(), found.end(), [](Candidate const& a, Candidate const& b) {
            return a.digest.feature == b.digest.feature;
        });
        return cache_.add(words_.data(), found.first(static_cast<std::size_t>(end - found.begin())));
    }

    std::span<Candidate> look_up(View const& view) {
        std::size_t const most =
            static_cast<std::size_t>(index_.size()) * static_cast<std::size_t>(index_.shape().tables) + 1;
        if (found_.size() < most) found_.resize(most * 2);
        return {found_.data(), static_cast<std::size_t>(index_.kernel().within(view, words_.data(), found_.data()))};
    }

    /// The nearest, unless none of the first `first` is promising.
    Match match(View const& view, Window const& window, std::span<Candidate const> candidates, std::size_t first = 0) {
        if (candidates.empty()) return {};
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

    ExactIndex const& index_;
    std::vector<std::uint64_t> words_;
    PatternCache cache_;
    std::vector<Candidate> found_, promising_;
};

std::unique_ptr<FeatureSearch> ExactIndex::search() const { return std::make_unique<ExactSearch>(*this); }

} // namespace

std::unique_ptr<FeatureIndex> make_exact_index(KnowledgeConfig const& config) {
    return std::make_unique<ExactIndex>(config);
}

} // namespace lore
