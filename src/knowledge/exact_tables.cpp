#include "exact_tables.h"
#include "exact_hash.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace lore::exact {

namespace {

/// The index in Tables::buckets of the bucket that a pattern belongs to.
std::size_t bucket_of(int table, std::uint64_t const* pattern, std::vector<std::uint64_t> const& masks, int words,
                      int slot_bits) {
    return (static_cast<std::size_t>(table) << slot_bits) +
           hash_slot(pattern, masks.data() + table * words, words, slot_bits);
}

int words_of_a_mask(std::vector<std::uint64_t> const& masks, int tables) {
    return static_cast<int>(masks.size()) / tables;
}

}   // namespace

std::uint64_t* Records::add() {
    words_.resize(words_.size() + size_);
    return words_.data() + words_.size() - size_;
}

GrowingTables::GrowingTables(int tables, std::vector<std::uint64_t> masks)
    : tables_(tables), words_(words_of_a_mask(masks, tables)), masks_(std::move(masks)),
      buckets_(static_cast<std::size_t>(tables) << slot_bits_) {}

void GrowingTables::add(Records const& records, Key const& key) {
    if (records.count() > std::size_t{1} << slot_bits_) double_slots(records);
    std::size_t const number = records.count() - 1;
    for (int table = 0; table < tables_; ++table)
        insert(table, records[number], key, static_cast<std::int32_t>(number));
}

void GrowingTables::insert(int table, std::uint64_t const* pattern, Key const& key, std::int32_t number) {
    Bucket& bucket = buckets_[bucket_of(table, pattern, masks_, words_, slot_bits_)];
    bool const full = bucket.count == 0 || std::has_single_bit(bucket.count);
    if (full) {
        std::uint32_t const start = take_room(std::max(1u, bucket.count * 2));
        std::copy_n(keys_.begin() + bucket.start, bucket.count, keys_.begin() + start);
        std::copy_n(numbers_.begin() + bucket.start, bucket.count, numbers_.begin() + start);
        if (bucket.count > 0) free_[static_cast<std::size_t>(std::countr_zero(bucket.count))].push_back(bucket.start);
        bucket.start = start;
    }
    keys_[bucket.start + bucket.count] = key;
    numbers_[bucket.start + bucket.count] = number;
    ++bucket.count;
    largest_ = std::max(largest_, std::size_t{bucket.count});
}

std::uint32_t GrowingTables::take_room(std::uint32_t places) {
    auto& free = free_[static_cast<std::size_t>(std::countr_zero(places))];
    if (!free.empty()) {
        std::uint32_t const start = free.back();
        free.pop_back();
        return start;
    }
    auto const start = static_cast<std::uint32_t>(numbers_.size());
    numbers_.resize(numbers_.size() + places);
    keys_.resize(numbers_.size());
    return start;
}

void GrowingTables::double_slots(Records const& records) {
    auto const old_buckets = std::move(buckets_);
    auto const old_keys = std::move(keys_);
    auto const old_numbers = std::move(numbers_);
    std::size_t const old_slots = std::size_t{1} << slot_bits_;
    ++slot_bits_;
    buckets_.assign(static_cast<std::size_t>(tables_) << slot_bits_, {});
    keys_.clear();
    numbers_.clear();
    for (auto& free : free_) free.clear();
    largest_ = 0;
    for (std::size_t i = 0; i < old_buckets.size(); ++i)
        for (std::uint32_t place = old_buckets[i].start; place < old_buckets[i].start + old_buckets[i].count; ++place) {
            std::int32_t const number = old_numbers[place];
            insert(static_cast<int>(i / old_slots), records[static_cast<std::size_t>(number)], old_keys[place], number);
        }
}

FixedTables::FixedTables(int tables, std::vector<std::uint64_t> const& masks, Records const& records)
    : masks_(&masks), slot_bits_(std::max(8, static_cast<int>(std::bit_width(records.count())))),
      features_(records.count()), buckets_(static_cast<std::size_t>(tables) << slot_bits_),
      records_(static_cast<std::size_t>(tables) * records.count() * records.record_words()) {
    int const words = words_of_a_mask(masks, tables);
    auto const each = [&](auto const& visit) {
        for (int table = 0; table < tables; ++table)
            for (std::size_t number = 0; number < records.count(); ++number)
                visit(buckets_[bucket_of(table, records[number], masks, words, slot_bits_)], records[number]);
    };
    each([](Bucket& bucket, std::uint64_t const*) { ++bucket.count; });
    std::uint32_t start = 0;
    for (Bucket& bucket : buckets_) {
        bucket.start = start;
        start += std::exchange(bucket.count, 0u);
    }
    each([&](Bucket& bucket, std::uint64_t const* record) {
        std::copy_n(record, records.record_words(),
                    records_.data() + (bucket.start + bucket.count++) * records.record_words());
    });
    auto const slots = std::ptrdiff_t{1} << slot_bits_;
    for (auto table = buckets_.begin(); table != buckets_.end(); table += slots)
        most_visits_ += std::ranges::max(std::span{table, table + slots}, {}, &Bucket::count).count;
}

double FixedTables::usual_visits() const {
    double squares = 0;
    for (Bucket const& bucket : buckets_) squares += static_cast<double>(bucket.count) * bucket.count;
    return features_ == 0 ? 0 : squares / static_cast<double>(features_);
}

RankedKeys::RankedKeys(std::span<Key const> keys, std::span<double const> worth) : numbers_(keys.size()) {
    std::iota(numbers_.begin(), numbers_.end(), 0);
    auto const worth_of = [&](std::int32_t feature) { return worth[static_cast<std::size_t>(feature)]; };
    std::stable_sort(numbers_.begin(), numbers_.end(),
                     [&](std::int32_t a, std::int32_t b) { return worth_of(a) > worth_of(b); });
    for (std::int32_t const feature : numbers_) keys_.push_back(keys[static_cast<std::size_t>(feature)]);
}

}   // namespace lore::exact
