#include "exact_tables.h"
#include "exact_hash.h"
#include "exact_keys.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace lore::exact {

namespace {

constexpr std::size_t features_a_slot = 4;   ///< of a set that grows, at most
constexpr std::uint32_t ordered_parts = 8;   ///< of a bucket: one is added, and it is put into order

/// The index in Tables::buckets of the bucket that a pattern belongs to.
std::size_t bucket_of(int table, std::uint64_t const* pattern, std::vector<std::uint64_t> const& masks, int words,
                      int slot_bits) {
    return (static_cast<std::size_t>(table) << slot_bits) +
           hash_slot(pattern, masks.data() + table * words, words, slot_bits);
}

/// A key's numbers: its sums, and then its ones.
std::uint8_t number(Key const& key, int which) { return reinterpret_cast<std::uint8_t const*>(&key)[which]; }

/// Makes a range of keys include one more. (Whatever it makes of their features.)
void widen(Key& least, Key& most, Key const& key) {
    using Bytes = Lanes<std::uint8_t, sizeof(Key)>;
    auto const low = lanes::cast_bits<Bytes>(least), high = lanes::cast_bits<Bytes>(most);
    auto const bytes = lanes::cast_bits<Bytes>(key);
    least = lanes::cast_bits<Key>(lanes::select(bytes < low, bytes, low));
    most = lanes::cast_bits<Key>(lanes::select(bytes > high, bytes, high));
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

void Records::clear() {
    count_ = 0;
    words_.resize(0);
}

void GroupedKeys::resize(std::size_t places) {
    size_ = places;
    keys_.resize((places + key_group - 1) / key_group);
    least_.resize((keys_.size() + key_group - 1) / key_group);
    most_.resize(least_.size());
}

void GroupedKeys::put(std::size_t place, std::span<Key const> keys) {
    while (!keys.empty()) {
        std::size_t const group = place / key_group, lane = place % key_group;
        std::size_t const count = std::min(keys.size(), key_group - lane);
        auto const range = static_cast<int>(group % key_group);
        KeyNumbers &leasts = least_[group / key_group], &mosts = most_[group / key_group];
        Key least = lane > 0 ? numbers_at(leasts, range) : keys[0];
        Key most = lane > 0 ? numbers_at(mosts, range) : keys[0];
        for (std::size_t i = 0; i < count; ++i) {
            put_numbers(keys_[group].numbers, static_cast<int>(lane + i), keys[i]);
            keys_[group].features[lane + i] = keys[i].feature;
            widen(least, most, keys[i]);
        }
        put_numbers(leasts, range, least);
        put_numbers(mosts, range, most);
        place += count;
        keys = keys.subspan(count);
    }
}

Key GroupedKeys::operator[](std::size_t place) const {
    KeyGroup const& group = keys_[place / key_group];
    auto const lane = static_cast<int>(place % key_group);
    Key key = numbers_at(group.numbers, lane);
    key.feature = group.features[lane];
    return key;
}

/// Halves them again and again by the number whose variance, of some of them, is the largest.
void GroupedKeys::order(std::span<Key> keys) {
    if (keys.size() <= key_group) return;
    constexpr std::size_t looked_at = 64;
    std::size_t const stride = std::max<std::size_t>(1, keys.size() / looked_at);
    std::array<std::uint32_t, key_size + 1> sums{}, squares{};
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < keys.size(); i += stride, ++count)
        for (int which = 0; which <= key_size; ++which) {
            std::uint32_t const x = number(keys[i], which);
            sums[static_cast<std::size_t>(which)] += x;
            squares[static_cast<std::size_t>(which)] += x * x;
        }
    auto const variance = [&](int which) {   // times the square of how many were looked at
        auto const i = static_cast<std::size_t>(which);
        return std::uint64_t{count} * squares[i] - std::uint64_t{sums[i]} * sums[i];
    };
    int widest = 0;
    for (int which = 1; which <= key_size; ++which)
        if (variance(which) > variance(widest)) widest = which;
    std::size_t const half = (keys.size() / key_group + 1) / 2 * key_group;
    std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(half), keys.end(),
                     [&](Key const& a, Key const& b) { return number(a, widest) < number(b, widest); });
    order(keys.first(half));
    order(keys.subspan(half));
}

GrowingTable::GrowingTable(std::vector<std::uint64_t> mask)
    : mask_(std::move(mask)), buckets_(std::size_t{1} << slot_bits_) {}

KeyedTable GrowingTable::view() const {
    KeyedTable view = keys_.view();
    view.mask = mask_.data();
    view.buckets = buckets_.data();
    view.slot_bits = slot_bits_;
    return view;
}

std::size_t GrowingTable::slot_of(std::uint64_t const* pattern) const {
    return hash_slot(pattern, mask_.data(), static_cast<int>(mask_.size()), slot_bits_);
}

void GrowingTable::add(Records const& patterns, Key const& key) {
    if (++features_ > features_a_slot << slot_bits_) double_slots(patterns);
    Bucket& bucket = buckets_[slot_of(patterns[static_cast<std::size_t>(key.feature)])];
    bool const full = bucket.count == 0 || std::has_single_bit(bucket.count);
    if (full) {
        std::span<Key const> const moving = keys_of(bucket);
        std::uint32_t const before = std::exchange(bucket.start, take_room(std::max(1u, bucket.count * 2)));
        if (bucket.count > 0) give_back(before, bucket.count);
        keys_.put(bucket.start, moving);
    }
    keys_.put(bucket.start + bucket.count, std::span{&key, 1});
    ++bucket.count;
    largest_ = std::max(largest_, std::size_t{bucket.count});
    std::uint32_t const part = std::max(2u * key_group, std::bit_floor(bucket.count) / ordered_parts);
    if (bucket.count % part == 0) put_into_order(bucket);
}

void GrowingTable::clear() {
    features_ = 0;
    largest_ = 0;
    std::fill_n(buckets_.data(), buckets_.size(), Bucket{});
    keys_.resize(0);
    for (auto& rooms : free_) rooms.clear();
}

void GrowingTable::put_into_order(Bucket bucket) {
    std::span<Key> const keys = keys_of(bucket);
    GroupedKeys::order(keys);
    keys_.put(bucket.start, keys);
}

std::span<Key> GrowingTable::keys_of(Bucket bucket) {
    moving_.resize(bucket.count);
    for (std::uint32_t i = 0; i < bucket.count; ++i) moving_[i] = keys_[bucket.start + i];
    return moving_;
}

std::uint32_t GrowingTable::take_room(std::uint32_t places) {
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

void GrowingTable::give_back(std::uint32_t start, std::uint32_t places) {
    free_[static_cast<std::size_t>(std::countr_zero(places))].push_back(start);
}

/// A slot has one bit more of the hash than before: each bucket becomes two, where its keys lie.
void GrowingTable::double_slots(Records const& patterns) {
    ++slot_bits_;
    PagedArray<Bucket> buckets{buckets_.size() * 2};
    largest_ = 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
        if (buckets_[i].count == 0) continue;
        auto const halves = split(buckets_[i], patterns);
        std::copy(halves.begin(), halves.end(), buckets.data() + 2 * i);
        for (Bucket const& half : halves) largest_ = std::max(largest_, std::size_t{half.count});
    }
    buckets_ = std::move(buckets);
}

std::array<Bucket, 2> GrowingTable::split(Bucket bucket, Records const& patterns) {
    std::span<Key> const all = keys_of(bucket);
    for (Key const& key : all) __builtin_prefetch(patterns[static_cast<std::size_t>(key.feature)]);
    auto const moving = std::stable_partition(all.begin(), all.end(), [&](Key const& key) {
        return slot_of(patterns[static_cast<std::size_t>(key.feature)]) % 2 == 0;
    });
    auto const stayed = static_cast<std::uint32_t>(moving - all.begin());
    if (stayed == bucket.count) return {bucket, Bucket{}};
    std::uint32_t const before = std::bit_ceil(bucket.count), now = std::bit_ceil(stayed);
    if (stayed == 0) give_back(bucket.start, before);
    else
        for (std::uint32_t room = before; room > now; room /= 2) give_back(bucket.start + room / 2, room / 2);
    std::array<Bucket, 2> const halves{{{stayed > 0 ? bucket.start : 0, stayed},
                                        {take_room(std::bit_ceil(bucket.count - stayed)), bucket.count - stayed}}};
    keys_.put(halves[0].start, all.first(stayed));
    keys_.put(halves[1].start, all.subspan(stayed));
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
