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
    /// As in PagedArray: memory is kept.
    void clear();
    std::uint64_t const* operator[](std::size_t feature) const { return words_.data() + feature * size_; }
    std::size_t count() const { return count_; }
    std::size_t record_words() const { return size_; }

private:
    std::size_t size_, count_ = 0;
    PagedArray<std::uint64_t> words_;
};

/// Keys, and what range those of each group have.
class GroupedKeys {
public:
    std::size_t size() const { return size_; }
    void resize(std::size_t places);
    /// Keys of places one after the other; those of a group in the order of their places.
    void put(std::size_t place, std::span<Key const>);
    Key operator[](std::size_t place) const;
    /// Puts keys into an order in which neighbors are alike, so that most groups of them are ruled out by their range.
    static void order(std::span<Key>);
    /// Without a hash table. Valid until places are added.
    KeyedTable view() const { return {keys_.data(), least_.data(), most_.data()}; }

private:
    std::size_t size_ = 0;
    PagedArray<KeyGroup> keys_;
    PagedArray<KeyNumbers> least_, most_;
};

/// A hash table of a set that grows: buckets hold keys, and what else is needed of the few that these do not rule out
/// is fetched by their feature. A bucket's keys are put into order whenever an eighth has been added.
class GrowingTable {
public:
    /// `mask`: the bits of a pattern that it hashes.
    explicit GrowingTable(std::vector<std::uint64_t> mask);

    /// The next feature, whose pattern is among `patterns`.
    void add(Records const& patterns, Key const&);
    /// Has no features, but the slots and the memory that it had: it is likely to have as many again.
    void clear();
    /// Valid until the next call of add.
    KeyedTable view() const;
    GroupedKeys const& keys() const { return keys_; }
    std::size_t largest_bucket() const { return largest_; }

private:
    std::size_t slot_of(std::uint64_t const* pattern) const;
    /// Room for places, a power of two, one after the other.
    std::uint32_t take_room(std::uint32_t places);
    void give_back(std::uint32_t start, std::uint32_t places);
    void double_slots(Records const&);
    std::array<Bucket, 2> split(Bucket, Records const&);
    void put_into_order(Bucket);
    /// A copy of a bucket's keys, valid until the next call.
    std::span<Key> keys_of(Bucket);

    std::vector<std::uint64_t> mask_;
    int slot_bits_ = 8;
    std::size_t features_ = 0;
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
