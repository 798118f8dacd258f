#include "archive/largest_allocation.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>

namespace {

std::atomic<std::size_t> largest{0};

} // namespace

std::size_t lore::take_largest_allocation() { return largest.exchange(0); }

// The other forms of new and delete come down to these.
void* operator new(std::size_t size) {
    for (std::size_t seen = largest; size > seen && !largest.compare_exchange_weak(seen, size);) {}
    if (void* const memory = std::malloc(std::max<std::size_t>(size, 1))) return memory;
    throw std::bad_alloc{};
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
