#include "exact_tables.h"
#include "exact_hash.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace lore::exact {

namespace {

constexpr std::size_t features_a_slot = 4;   ///< of a set that grows, at most

/// The index in Tables::buckets of the bucket that a pattern belongs to.
std::size_t bucket_of(int table, std::uint64_t const* pattern, std::vector<std::uint64_t> const& masks, int words,
                      int slot_bits) {
    return (static_cast<std::size_t>(table) << slot_bits) +
           hash_slot(pattern, masks.data() + table * words, words, slot_bits);
}

/// Makes a range of keys include one more.
void widen(Key& least, Key& most, Key const& key) {
    for (int i = 0; i < key_size; ++i) {
        least.sums[i] = std::min(least.sums[i], key.sums[i]);
        most.sums[i] = std::max(most.sums[i], key.sums[i]);
    }
    least.ones = std::min(least.ones, key.ones);
    most.ones = std::max(most.ones, key.ones);
}

int words_of_a_mask(std::vector<std::uint64_t> const& masks, int tables) {
    return static_cast<int>(masks.size()) / tables;
}

}   // namespace

std::uint64_t* Records::add() {
    ++count_;
    words_.resize(count_ * size_);
    return words_.data() + words_.size() - size_;
}

void GroupedKeys::resize(std::size_t places) {
    keys_.resize(places);
    least_.resize((places + key_group - 1) / key_group);
    most_.resize(least_.size());
}

void GroupedKeys::put(std::size_t place, Key const& key) {
    keys_[place] = key;
    std::size_t const group = place / key_group;
    if (place % key_group == 0) {
        least_[group] = most_[group] = key;
        least_[group].feature = static_cast<std::int32_t>(group);
    } else {
        widen(least_[group], most_[group], key);
    }
}

/// Halves them again and again by the number that differs most.
void GroupedKeys::order(std::span<Key> keys) {
    if (keys.size() <= key_group) return;
    Key least = keys[0], most = keys[0];
    for (Key const& key : keys) widen(least, most, key);
    auto const number = [](Key const& key, int which) { return which < key_size ? key.sums[which] : key.ones; };
    auto const width = [&](int which) { return number(most, which) - number(least, which); };
    int widest = 0;
    for (int which = 1; which <= key_size; ++which)
        if (width(which) > width(widest)) widest = which;
    std::size_t const half = (keys.size() / key_group + 1) / 2 * key_group;
    std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(half), keys.end(),
                     [&](Key const& a, Key const& b) { return number(a, widest) < number(b, widest); });
    order(keys.first(half));
    order(keys.subspan(half));
}

GrowingTables::GrowingTables(int tables, std::vector<std::uint64_t> masks)
    : tables_(tables), words_(words_of_a_mask(masks, tables)), masks_(std::move(masks)),
      buckets_(static_cast<std::size_t>(tables) << slot_bits_) {}

void GrowingTables::add(Records const& patterns, Key key) {
    if (patterns.count() > features_a_slot << slot_bits_) double_slots(patterns);
    key.feature = static_cast<std::int32_t>(patterns.count() - 1);
    for (int table = 0; table < tables_; ++table) insert(table, patterns, key);
}

void GrowingTables::insert(int table, Records const& patterns, Key const& key) {
    Bucket& bucket =
        buckets_[bucket_of(table, patterns[static_cast<std::size_t>(key.feature)], masks_, words_, slot_bits_)];
    bool const full = bucket.count == 0 || std::has_single_bit(bucket.count);
    if (full) {
        std::span<Key> const moving = keys_of(bucket);
        std::uint32_t const before = std::exchange(bucket.start, take_room(std::max(1u, bucket.count * 2)));
        if (bucket.count > 0) give_back(before, bucket.count);
        GroupedKeys::order(moving);
        std::uint32_t place = bucket.start;
        for (Key const& moved : moving) keys_.put(place++, moved);
    }
    keys_.put(bucket.start + bucket.count, key);
    ++bucket.count;
    largest_ = std::max(largest_, std::size_t{bucket.count});
}

std::span<Key> GrowingTables::keys_of(Bucket bucket) {
    Key const* const first = keys_.keys() + bucket.start;
    moving_.assign(first, first + bucket.count);
    return moving_;
}

std::uint32_t GrowingTables::take_room(std::uint32_t places) {
    auto& free = free_[static_cast<std::size_t>(std::countr_zero(places))];
    if (!free.empty()) {
        std::uint32_t const start = free.back();
        free.pop_back();
        return start;
    }
    if (places < key_group) {   // rooms begin at whole groups, or are a part of one
        std::uint32_t const start = take_room(places * 2);
        give_back(start + places, places);
        return start;
    }
    auto const start = static_cast<std::uint32_t>(keys_.size());
    keys_.resize(keys_.size() + places);
    return start;
}

void GrowingTables::give_back(std::uint32_t start, std::uint32_t places) {
    free_[static_cast<std::size_t>(std::countr_zero(places))].push_back(start);
}

/// A slot has one bit more of the hash than before: each bucket becomes two, where its keys lie.
void GrowingTables::double_slots(Records const& patterns) {
    ++slot_bits_;
    PagedArray<Bucket> buckets{buckets_.size() * 2};
    largest_ = 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
        if (buckets_[i].count == 0) continue;
        auto const halves = split(static_cast<int>(i >> (slot_bits_ - 1)), buckets_[i], patterns);
        std::copy(halves.begin(), halves.end(), buckets.data() + 2 * i);
        for (Bucket const& half : halves) largest_ = std::max(largest_, std::size_t{half.count});
    }
    buckets_ = std::move(buckets);
}

std::array<Bucket, 2> GrowingTables::split(int table, Bucket bucket, Records const& patterns) {
    std::span<Key> const all = keys_of(bucket);
    auto const moving = std::stable_partition(all.begin(), all.end(), [&](Key const& key) {
        return bucket_of(table, patterns[static_cast<std::size_t>(key.feature)], masks_, words_, slot_bits_) % 2 == 0;
    });
    auto const stayed = static_cast<std::uint32_t>(moving - all.begin());
    if (stayed == bucket.count) return {bucket, Bucket{}};
    std::uint32_t const before = std::bit_ceil(bucket.count), now = std::bit_ceil(stayed);
    if (stayed == 0) give_back(bucket.start, before);
    else
        for (std::uint32_t room = before; room > now; room /= 2) give_back(bucket.start + room / 2, room / 2);
    std::array<Bucket, 2> const halves{{{stayed > 0 ? bucket.start : 0, stayed},
                                        {take_room(std::bit_ceil(bucket.count - stayed)), bucket.count - stayed}}};
    std::uint32_t place = halves[0].start;
    for (auto key = all.begin(); key != all.end(); ++key) {
        if (key == moving) place = halves[1].start;
        keys_.put(place++, *key);
    }
    return halves;
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

}   // namespace lore::exact
