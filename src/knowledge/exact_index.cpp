#include "exact_hash.h"
#include "exact_kernel.h"

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
using exact::Query;
using exact::View;

struct alignas(64) CacheLine { std::byte bytes[64]; };

constexpr int partial_sums = 16;
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
        shape.scales[half] = halves[half] == 0 ? 0.0f : static_cast<float>(exact::summary_scale / std::sqrt(static_cast<double>(shape.first_half) * halves[half]));
    shape.value_stride = (config.window_length * continuous_count + partial_sums - 1) / partial_sums * partial_sums;
    shape.most_differing = most_differing_bits(config);
    shape.tables = bits / (shape.most_differing + 1) >= fewest_block_bits ? shape.most_differing + 1 : 1;
    shape.squared_threshold = config.squared_threshold();
    shape.entry_size = shape.words + 1;
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
    double const rounding = 0.5 + shape.first_half * 0x1p-10;   // of one number of a summary, sum and quantisation
    double const slack = 2 * rounding * std::sqrt(static_cast<double>(exact::summary_numbers));
    std::vector<std::int32_t> limits;
    for (int differing = 0; differing <= shape.most_differing; ++differing) {
        double const left = std::max(0.0, static_cast<double>(shape.squared_threshold) * (1 + relative_error) - differing);
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

/// A query and its memory.
struct QueryBuffer {
    explicit QueryBuffer(exact::Shape const& shape) : words(static_cast<std::size_t>(shape.words)) { query.words = words.data(); }
    QueryBuffer(QueryBuffer const&) = delete;
    std::vector<std::uint64_t> words;
    Query query{};
};

class ExactIndex : public FeatureIndex {
public:
    explicit ExactIndex(KnowledgeConfig const& config)
        : shape_(shape_of(config)), masks_(masks_of(shape_)), limits_(limits_of(shape_)), kernel_(kernel_of(active_isa())),
          buffer_(shape_) {
        double_slots();
    }

    void add(Window const& window) override;
    int size() const override { return size_; }
    std::unique_ptr<FeatureSearch> search() const override;
    void set_values(std::span<double const> values) override {
        assert(values.size() == static_cast<std::size_t>(size_));
        worth_.assign(values.begin(), values.end());
    }

    exact::Shape const& shape() const { return shape_; }
    exact::Kernel const& kernel() const { return kernel_; }
    std::span<double const> worth() const { return worth_; }
    View view() const {
        return {shape_, masks_.data(), buckets_.data(), slot_bits_, entries_.data(), summaries_.data(),
                reinterpret_cast<float const*>(values_.data()), limits_.data()};
    }

private:
    /// The bucket of one table that a pattern belongs to.
    exact::Bucket& bucket_of(int table, std::uint64_t const* words) {
        std::uint64_t const slot = exact::hash_slot(words, masks_.data() + table * shape_.words, shape_.words, slot_bits_);
        return buckets_[(static_cast<std::size_t>(table) << slot_bits_) + slot];
    }
    void insert(int table, std::uint64_t const* words, int feature);
    void double_slots();

    exact::Shape shape_;
    std::vector<std::uint64_t> masks_;
    std::vector<std::int32_t> limits_;
    exact::Kernel kernel_;
    QueryBuffer buffer_;
    int slot_bits_ = 7;                        ///< always at least as many slots as features
    std::vector<exact::Bucket> buckets_;
    std::vector<std::uint64_t> entries_;
    std::vector<std::uint64_t> patterns_;      ///< [feature][word]
    std::vector<std::int16_t> summaries_;
    std::vector<CacheLine> values_;
    std::vector<double> worth_;
    int size_ = 0;
};

void ExactIndex::add(Window const& window) {
    assert(window.bits.size() == static_cast<std::size_t>(shape_.window_length) && worth_.empty());
    Query& query = buffer_.query;
    kernel_.prepare(shape_, window.bits.data(), window.values.data(), query);
    patterns_.insert(patterns_.end(), query.words, query.words + shape_.words);
    summaries_.insert(summaries_.end(), query.summary, query.summary + exact::summary_size);
    std::size_t const lines = static_cast<std::size_t>(shape_.value_stride) * sizeof(float) / sizeof(CacheLine);
    values_.resize(values_.size() + lines);
    std::memcpy(values_.data() + values_.size() - lines, window.values.data(), window.values.size_bytes());
    int const feature = size_++;
    if (static_cast<std::size_t>(size_) > std::size_t{1} << slot_bits_) double_slots();
    else for (int table = 0; table < shape_.tables; ++table) insert(table, query.words, feature);
}

/// A bucket has room for as many entries as the next power of two; where that is full, it moves to the end of entries_.
/// The places left behind are as many as those in use at most, until double_slots() clears them away.
void ExactIndex::insert(int table, std::uint64_t const* words, int feature) {
    exact::Bucket& bucket = bucket_of(table, words);
    auto const entry_size = static_cast<std::size_t>(shape_.entry_size);
    if (std::has_single_bit(bucket.count) || bucket.count == 0) {
        std::size_t const room = std::max<std::size_t>(1, std::size_t{bucket.count} * 2);
        std::size_t const start = entries_.size() / entry_size;
        entries_.resize(entries_.size() + room * entry_size);
        std::copy_n(entries_.data() + bucket.start * entry_size, bucket.count * entry_size, entries_.data() + start * entry_size);
        bucket.start = static_cast<std::uint32_t>(start);
    }
    std::uint64_t* const entry = entries_.data() + (bucket.start + bucket.count) * entry_size;
    std::copy_n(words, shape_.words, entry);
    entry[shape_.words] = static_cast<std::uint64_t>(feature);
    ++bucket.count;
}

void ExactIndex::double_slots() {
    ++slot_bits_;
    buckets_.assign(static_cast<std::size_t>(shape_.tables) << slot_bits_, {0, 0});
    entries_.clear();
    for (int table = 0; table < shape_.tables; ++table)
        for (int feature = 0; feature < size_; ++feature)
            insert(table, patterns_.data() + static_cast<std::size_t>(feature) * static_cast<std::size_t>(shape_.words), feature);
}

class ExactSearch : public FeatureSearch {
public:
    explicit ExactSearch(ExactIndex const& index) : index_(index), buffer_(index.shape()) {}

    Match match(Window const& window) override { return nearest(index_.view(), collect(window)); }

    Match match_above(Window const& window, double least) override {
        int const count = collect(window);
        auto const worth = index_.worth();
        bool const worthwhile = std::any_of(candidates_.begin(), candidates_.begin() + count, [&](Candidate const& candidate) {
            return worth[static_cast<std::size_t>(candidate.feature)] > least;
        });
        return worthwhile ? nearest(index_.view(), count) : Match{};
    }

private:
    int collect(Window const& window) {
        assert(window.bits.size() == static_cast<std::size_t>(index_.shape().window_length));
        std::size_t const most = static_cast<std::size_t>(index_.size()) * static_cast<std::size_t>(index_.shape().tables) + 1;
        if (candidates_.size() < most) candidates_.resize(most * 2);
        index_.kernel().prepare(index_.shape(), window.bits.data(), window.values.data(), buffer_.query);
        return index_.kernel().collect(index_.view(), buffer_.query, candidates_.data());
    }
    Match nearest(View const& view, int count) const {
        exact::Nearest const found = index_.kernel().nearest(view, buffer_.query, candidates_.data(), count);
        return found.feature < 0 ? Match{} : Match{found.feature, found.squared_distance};
    }

    ExactIndex const& index_;
    QueryBuffer buffer_;
    std::vector<Candidate> candidates_;
};

std::unique_ptr<FeatureSearch> ExactIndex::search() const { return std::make_unique<ExactSearch>(*this); }

} // namespace

std::unique_ptr<FeatureIndex> make_exact_index(KnowledgeConfig const& config) { return std::make_unique<ExactIndex>(config); }

} // namespace lore
