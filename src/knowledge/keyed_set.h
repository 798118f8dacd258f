#pragma once

#include "exact_kernel.h"
#include "exact_tables.h"

#include <lore/core/crew.h>
#include <lore/core/paged_array.h>
#include <lore/knowledge/index.h>

#include <functional>
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

/// A set that grows: all but the values of its windows.
class KeyedSet {
public:
    /// `shape` must outlive it.
    explicit KeyedSet(Shape const& shape);

    /// The next feature.
    void add(Question const&);
    /// The next features. The crew shares its tables and, as one of them, `beside`.
    void add(std::span<Question const>, Crew&, std::function<void()> const& beside);
    /// Has no features, but the memory of those that it had.
    void clear();
    std::size_t size() const { return patterns_.count(); }
    std::size_t largest_bucket() const;
    /// Valid until features are added.
    KeyedView view() const { return {*shape_, views_.data(), patterns_[0], codes_.data()}; }

private:
    void keep(Question const&);
    void fill(std::size_t table, std::size_t first, std::span<Question const>);

    Shape const* shape_;
    Records patterns_;
    PagedArray<std::uint8_t> codes_;
    std::vector<GrowingTable> tables_;
    std::vector<KeyedTable> views_;   ///< of the tables
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
