#include "edit_kernel.h"
#include "fast_distances.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace lore {

namespace {

using Path = std::vector<Tile>;

/// The different paths of a pool, each once: many robots travel alike.
///
/// Those that appear in the rows to be measured come last, so that row r needs the distances to all paths before it.
/// Otherwise by length, because only paths of one length have bands, and then in lexicographic order, which puts
/// similar paths, and so similar bands, side by side.
struct DistinctPaths {
    std::vector<Path const*> paths;
    std::vector<int> place;   ///< of each member's path in `paths`
    int first_row = 0;        ///< place of the first path that appears in the rows
};

DistinctPaths distinct_paths(std::span<Descriptors const* const> pool, int first) {
    auto const path = [&](int member) -> Path const& { return pool[member]->path; };
    auto const before = [](Path const& a, Path const& b) {
        if (a.size() != b.size()) return a.size() < b.size();
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                            [](Tile s, Tile t) { return tile_index(s) < tile_index(t); });
    };
    std::vector<int> order(pool.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return before(path(a), path(b)); });

    DistinctPaths distinct;
    distinct.place.resize(pool.size());
    std::vector<std::vector<int>> sharing;
    for (int const member : order) {
        if (sharing.empty() || path(sharing.back()[0]) != path(member)) sharing.emplace_back();
        sharing.back().push_back(member);
    }
    auto const is_row = [&](std::vector<int> const& members) {
        return std::any_of(members.begin(), members.end(), [&](int m) { return m >= first; });
    };
    auto const rows =
        std::stable_partition(sharing.begin(), sharing.end(), [&](auto const& members) { return !is_row(members); });
    distinct.first_row = static_cast<int>(rows - sharing.begin());
    for (std::vector<int> const& members : sharing) {
        for (int const member : members) distinct.place[member] = static_cast<int>(distinct.paths.size());
        distinct.paths.push_back(&path(members[0]));
    }
    return distinct;
}

/// Measures one group of paths against many others.
class GroupMeasure {
public:
    explicit GroupMeasure(std::size_t longest)
        : kernel_(kernel_for(active_isa(), LORE_KERNELS(edit))()), tiles_(longest),
          substitution_(tile_count * (longest + 1)), across_(longest + 1), diagonal_(longest + 1),
          follows_(new bool[tile_count * tile_count]), costs_(kernel_.lanes), lengths_(kernel_.lanes) {}

    int lanes() const { return kernel_.lanes; }

    /// At most lanes() paths.
    void set_group(std::span<Path const* const> members) {
        members_ = static_cast<int>(members.size());
        std::size_t longest = 0;
        for (Path const* path : members) longest = std::max(longest, path->size());
        same_length_ =
            std::all_of(members.begin(), members.end(), [&](Path const* path) { return path->size() == longest; });
        auto* const tiles = reinterpret_cast<std::uint8_t*>(tiles_.data());
        for (int lane = 0; lane < lanes(); ++lane) {
            Path const& path = *members[std::min(lane, members_ - 1)];
            lengths_[lane] = static_cast<int>(path.size());
            for (std::size_t j = 0; j < longest; ++j)
                tiles[j * lanes() + lane] = static_cast<std::uint8_t>(j < path.size() ? tile_index(path[j]) : 0);
        }
        group_ = {tiles, static_cast<int>(longest), reinterpret_cast<std::int8_t*>(substitution_.data()),
                  follows_.get()};
        kernel_.prepare(group_);
    }

    /// Twelfths, from the path to each of the group's first `count` members.
    std::span<std::int32_t const> costs_of(Path const& path, int count) {
        row_.clear();
        for (Tile const tile : path) row_.push_back(static_cast<std::uint8_t>(tile_index(tile)));
        EditRows const rows{reinterpret_cast<std::int8_t*>(across_.data()),
                            reinterpret_cast<std::int8_t*>(diagonal_.data())};
        auto const wanted = std::span{costs_}.first(static_cast<std::size_t>(count));
        if (same_length_ && static_cast<int>(row_.size()) == group_.columns) {
            // A script that strays to offset k inserts k tiles and deletes k, at 24 k twelfths; one that is no dearer
            // than step-by-step substitution therefore stays within that price / 24.
            kernel_.diagonal_costs(group_, row_.data(), costs_.data());
            int const band =
                std::min(*std::max_element(wanted.begin(), wanted.end()) / (2 * tiles_per_side), group_.columns);
            kernel_.banded_costs(group_, row_.data(), band, rows, costs_.data());
        } else {
            kernel_.full_costs(group_, row_.data(), static_cast<int>(row_.size()), lengths_.data(), rows,
                               costs_.data());
        }
        return wanted;
    }

private:
    EditKernel kernel_;
    std::vector<CacheLine> tiles_, substitution_, across_, diagonal_;   ///< a line holds the lanes of a column
    std::unique_ptr<bool[]> follows_;
    std::vector<std::int32_t> costs_;
    std::vector<int> lengths_;
    std::vector<std::uint8_t> row_;
    PathGroup group_{};
    int members_ = 0;
    bool same_length_ = true;
};

}   // namespace

void measure_trajectory_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix& matrix) {
    if (first >= last) return;
    DistinctPaths const distinct = distinct_paths(pool.first(static_cast<std::size_t>(last)), first);
    int const count = static_cast<int>(distinct.paths.size());
    std::size_t longest = 0;
    for (Path const* path : distinct.paths) longest = std::max(longest, path->size());

    // twelfths[row][place], place < row, by place of the path
    std::vector<std::int32_t> twelfths(static_cast<std::size_t>(count - distinct.first_row) * count);
    auto const row_of = [&](int place) {
        return twelfths.data() + static_cast<std::ptrdiff_t>(place - distinct.first_row) * count;
    };
    GroupMeasure measure(longest);
    for (int start = 0; start < count; start += measure.lanes()) {
        int const members = std::min(measure.lanes(), count - start);
        measure.set_group(
            std::span{distinct.paths}.subspan(static_cast<std::size_t>(start), static_cast<std::size_t>(members)));
        for (int row = std::max(distinct.first_row, start + 1); row < count; ++row) {
            auto const costs = measure.costs_of(*distinct.paths[row], std::min(members, row - start));
            std::copy(costs.begin(), costs.end(), row_of(row) + start);
        }
    }
    for (int i = first; i < last; ++i) {
        double* const row = matrix.row(i);
        for (int j = 0; j < i; ++j) {
            auto const [low, high] = std::pair{std::min(distinct.place[i], distinct.place[j]),
                                               std::max(distinct.place[i], distinct.place[j])};
            row[j] = low == high ? 0.0 : row_of(high)[low] / static_cast<double>(tiles_per_side);
        }
    }
}

}   // namespace lore
