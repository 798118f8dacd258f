#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <vector>

namespace lore {

/// Shares `count` items among threads, `share` neighbors at a time: calls work(thread, first, last) until all are done,
/// from this thread, number 0, and threads - 1 others. Rethrows what one of them has thrown.
template <class Work>
void in_parallel(std::size_t count, std::size_t share, int threads, Work const& work) {
    std::atomic<std::size_t> taken{0};
    auto const take = [&](int thread) {
        for (std::size_t first; (first = taken.fetch_add(share)) < count;)
            work(static_cast<std::size_t>(thread), first, std::min(first + share, count));
    };
    std::vector<std::future<void>> helpers;   // joined when they are destroyed, too
    for (int thread = 1; thread < threads; ++thread) helpers.push_back(std::async(std::launch::async, take, thread));
    take(0);
    for (std::future<void>& helper : helpers) helper.get();
}

}   // namespace lore
