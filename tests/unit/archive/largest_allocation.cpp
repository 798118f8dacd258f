#include "archive/largest_allocation.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>

namespace {

std::atomic<std::size_t> largest{0};

}   // namespace

std::size_t lore::take_largest_allocation() { return largest.exchange(0); }

// Arrays come down to these; a sanitizer's own forms without exceptions would not.
void* operator new(std::size_t size, std::nothrow_t const&) noexcept {
    for (std::size_t seen = largest; size > seen && !largest.compare_exchange_weak(seen, size);) {}
    return std::malloc(std::max<std::size_t>(size, 1));
}
void* operator new(std::size_t size) {
    if (void* const memory = operator new(size, std::nothrow)) return memory;
    throw std::bad_alloc{};
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::nothrow_t const&) noexcept { std::free(memory); }
