#pragma once

#include <algorithm>

namespace lore {

/// How many genomes of a request each worker gets: an even share, rounded up to half sets of its lanes (one vector). A
/// set takes the same time however few it holds, so rank 0, which has other duties, evaluates what is left.
inline int share_of_a_worker(int genomes, int ranks, int lanes) {
    int const half_set = std::max(1, lanes / 2);
    return (genomes + ranks * half_set - 1) / (ranks * half_set) * half_set;
}

}   // namespace lore
