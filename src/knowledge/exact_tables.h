#pragma once

#include "exact_kernel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lore::exact {

/// A feature's pattern and Digest, one after the other: what is held against a window that shares a block of bits.
class Records {
public:
    explicit Records(int words) : size_(static_cast<std::size_t>(record_size(words))) {}
    /// The next feature's, to be filled in.
    std::uint64_t* add();
    void reserve(std::size_t features) { words_.reserve(features * size_); }
    std::uint64_t const* operator[](std::size_t feature) const { return words_.data() + feature * size_; }
    std::size_t count() const { return words_.size() / size_; }
    std::size_t record_words() const { return size_; }

private:
    std::size_t size_;
    std::vector<std::uint64_t> words_;
};

/// Hash tables of a set that grows: buckets hold keys and numbers, 12 bytes a feature, and what else is needed of the
/// few that these do not rule out is fetched from the records.
class GrowingTables {
public:
    GrowingTables(int tables, std::vector<std::uint64_t> masks);

    /// The last of the records, which `key` belongs to.
    void add(Records const&, Key const&);
    Tables view() const { return {masks_.data(), buckets_.data(), slot_bits_}; }
    Key const* keys() const { return keys_.data(); }
    std::int32_t const* numbers() const { return numbers_.data(); }
    std::size_t largest_bucket() const { return largest_; }

private:
    void insert(int table, std::uint64_t const* pattern, Key const&, std::int32_t number);
    std::uint32_t take_room(std::uint32_t places);
    void double_slots(Records const&);

    int tables_, words_;
    std::vector<std::uint64_t> masks_;
    int slot_bits_ = 8;                   ///< always at least as many slots as features
    std::vector<Bucket> buckets_;         ///< with room for as many places as the next power of two
    std::vector<Key> keys_;               ///< [place]
    std::vector<std::int32_t> numbers_;   ///< [place]
    std::array<std::vector<std::uint32_t>, 32>
        free_;   ///< room left behind by buckets that moved, by log2 of its places
    std::size_t largest_ = 0;
};

/// Hash tables of a final set: buckets hold whole records.
class FixedTables {
public:
    FixedTables(int tables, std::vector<std::uint64_t> const& masks, Records const&);

    Tables view() const { return {masks_->data(), buckets_.data(), slot_bits_}; }
    std::uint64_t const* records() const { return records_.data(); }
    /// Records in the buckets of a pattern like those of the set: the mean over its features.
    double usual_visits() const;
    /// Records in the buckets of any pattern: at most so many.
    std::size_t most_visits() const { return most_visits_; }

private:
    std::vector<std::uint64_t> const* masks_;
    int slot_bits_;
    std::size_t features_;
    std::vector<Bucket> buckets_;
    std::vector<std::uint64_t> records_;   ///< [place][record_size]
    std::size_t most_visits_ = 0;          ///< the largest buckets of all tables together
};

/// The keys of a final set whose bits tell its features not apart, in falling order of worth, then of numbers.
class RankedKeys {
public:
    /// One of each a feature.
    RankedKeys(std::span<Key const> keys, std::span<double const> worth);
    Key const* keys() const { return keys_.data(); }
    std::int32_t const* numbers() const { return numbers_.data(); }

private:
    std::vector<Key> keys_;
    std::vector<std::int32_t> numbers_;
};

}   // namespace lore::exact
