#pragma once

#include "exact_kernel.h"

#include <lore/core/paged_array.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lore::exact {

/// As many words a feature, beginning with its pattern; none if there are no binary channels.
class Records {
public:
    explicit Records(int words) : size_(static_cast<std::size_t>(words)) {}
    /// The next feature's, to be filled in.
    std::uint64_t* add();
    std::uint64_t const* operator[](std::size_t feature) const { return words_.data() + feature * size_; }
    std::size_t count() const { return count_; }
    std::size_t record_words() const { return size_; }

private:
    std::size_t size_, count_ = 0;
    PagedArray<std::uint64_t> words_;
};

/// Keys, and what range those of each group have: KeyedView::keys, ::least and ::most.
class GroupedKeys {
public:
    std::size_t size() const { return keys_.size(); }
    void resize(std::size_t places);
    /// Those of a group in the order of their places.
    void put(std::size_t place, Key const&);
    /// Puts keys into an order in which neighbors are alike, so that most groups of them are ruled out by their range.
    static void order(std::span<Key>);
    Key const* keys() const { return keys_.data(); }
    Key const* least() const { return least_.data(); }
    Key const* most() const { return most_.data(); }

private:
    PagedArray<Key> keys_, least_, most_;   ///< the feature of a least one is its group's number
};

/// Hash tables of a set that grows: buckets hold keys, and what else is needed of the few that these do not rule out is
/// fetched by their feature. Where a bucket doubles, its keys are put into order.
class GrowingTables {
public:
    GrowingTables(int tables, std::vector<std::uint64_t> masks);

    /// The last of the patterns, which `key` belongs to.
    void add(Records const& patterns, Key);
    Tables view() const { return {masks_.data(), buckets_.data(), slot_bits_}; }
    GroupedKeys const& keys() const { return keys_; }
    std::size_t largest_bucket() const { return largest_; }

private:
    void insert(int table, Records const&, Key const&);
    /// Room for places, a power of two, one after the other.
    std::uint32_t take_room(std::uint32_t places);
    void give_back(std::uint32_t start, std::uint32_t places);
    void double_slots(Records const&);
    std::array<Bucket, 2> split(int table, Bucket, Records const&);
    /// A copy of a bucket's keys, valid until the next call.
    std::span<Key> keys_of(Bucket);

    int tables_, words_;
    std::vector<std::uint64_t> masks_;
    int slot_bits_ = 8;
    PagedArray<Bucket> buckets_;                        ///< with room for as many places as the next power of two
    GroupedKeys keys_;                                  ///< [place]
    std::array<std::vector<std::uint32_t>, 32> free_;   ///< room that buckets have left behind, by log2 of its places
    std::size_t largest_ = 0;
    std::vector<Key> moving_;   // scratch
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

}   // namespace lore::exact
