#pragma once

#include "exact_kernel.h"
#include "exact_tables.h"

#include <lore/core/paged_array.h>
#include <lore/knowledge/index.h>

#include <limits>
#include <span>
#include <vector>

// Sets whose features are found by their keys, and how they are asked. A search ends with finalists: features that may
// be the nearest as far as bits and codes tell, mostly one. Only theirs of all windows are read, wherever these are.
namespace lore::exact {

/// What the kernel makes of windows to ask for them, and to keep them.
class Descriptions {
public:
    explicit Descriptions(Shape const& shape) : shape_(&shape) {}
    void resize(std::size_t windows);
    /// Threads may describe different windows at once.
    void describe(std::size_t number, Kernel const&, Window const&);
    Question operator[](std::size_t number) const;

private:
    Shape const* shape_;
    PagedArray<std::uint64_t> patterns_;
    PagedArray<std::uint8_t> codes_;
    PagedArray<Key> keys_;
};

inline KeyedView keyed_view(Shape const& shape, Tables const& tables, GroupedKeys const& keys, Records const& patterns,
                            PagedArray<std::uint8_t> const& codes) {
    return {shape, tables, keys.keys(), keys.least(), keys.most(), patterns[0], codes.data()};
}

/// A set that grows: all but the values of its windows.
class KeyedSet {
public:
    /// `shape` must outlive it.
    KeyedSet(Shape const& shape, std::vector<std::uint64_t> masks)
        : shape_(&shape), patterns_(shape.words), tables_(growing_tables(shape), std::move(masks)) {}

    void add(Question const&);
    std::size_t size() const { return patterns_.count(); }
    std::size_t largest_bucket() const { return tables_.largest_bucket(); }
    KeyedView view() const { return keyed_view(*shape_, tables_.view(), tables_.keys(), patterns_, codes_); }

private:
    Shape const* shape_;
    Records patterns_;
    GrowingTables tables_;
    PagedArray<std::uint8_t> codes_;
};

inline constexpr std::int32_t all_features = std::numeric_limits<std::int32_t>::max();

/// What windows with the same bits, or like keys, matched last.
using RecentMatches = std::vector<std::int32_t>;
inline RecentMatches no_recent_matches() { return RecentMatches(std::size_t{1} << recent_bits, -1); }

/// The memory of one search at a time.
class SearchMemory {
public:
    /// Valid until the next call, and as long as `recent`, which may be null: then nothing is remembered.
    Scratch room_for(Shape const&, std::size_t largest_bucket, RecentMatches* recent);
    /// Of a search with this memory.
    std::span<Finalist const> finalists(Search const& search) const {
        return {finalists_.data(), static_cast<std::size_t>(search.finalists)};
    }

private:
    std::vector<Visit> visits_;
    std::vector<std::int32_t> features_, apart_, groups_;
    std::vector<Promising> promising_;
    PagedArray<Finalist> finalists_;   // of the room that they might need they hardly ever touch a page
    Recent last_{0, -1};
};

/// The nearest of the finalists if it is within the threshold; among equals the lowest number. `values_of`: feature to
/// the values of its window.
template <class ValuesOf>
Match nearest_of(std::span<Finalist const> finalists, Kernel const& kernel, Shape const& shape, float const* values,
                 ValuesOf const& values_of) {
    Match nearest;
    for (Finalist const& one : finalists) {
        float const distance =
            kernel.distance(shape, values, values_of(one.feature)) + static_cast<float>(one.differing);
        if (!(distance < shape.squared_threshold)) continue;
        bool const nearer = distance < nearest.squared_distance ||
                            (distance == nearest.squared_distance && one.feature < nearest.feature);
        if (nearer) nearest = {one.feature, distance};
    }
    return nearest;
}

}   // namespace lore::exact
