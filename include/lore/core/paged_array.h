#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

#include <sys/mman.h>

namespace lore {

/// A vector for arrays of gigabytes, read here and there: the kernel moves its pages when it grows, so that nothing is
/// copied and never are there two of it; what was not written takes no memory; and from 2 MiB on it has large pages
/// where the kernel has them, since to find a small page takes longer than to read from it. It begins at a page. New
/// items are 0, unless there were some before where they are.
template <class T>
class PagedArray {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    PagedArray() = default;
    /// Throws std::bad_alloc.
    explicit PagedArray(std::size_t size) { resize(size); }
    PagedArray(PagedArray&& other) noexcept
        : items_(std::exchange(other.items_, nullptr)), size_(std::exchange(other.size_, 0)),
          bytes_(std::exchange(other.bytes_, 0)) {}
    PagedArray& operator=(PagedArray&& other) noexcept {
        std::swap(items_, other.items_);
        std::swap(size_, other.size_);
        std::swap(bytes_, other.bytes_);
        return *this;
    }
    ~PagedArray() {
        if (items_ != nullptr) ::munmap(items_, bytes_);
    }

    T* data() { return items_; }
    T const* data() const { return items_; }
    T& operator[](std::size_t i) { return items_[i]; }
    T const& operator[](std::size_t i) const { return items_[i]; }
    std::size_t size() const { return size_; }

    /// Memory is never given back. Pointers to items are lost. Throws std::bad_alloc.
    void resize(std::size_t size) {
        if (size * sizeof(T) > bytes_) reserve(size);
        size_ = size;
    }
    void push_back(T const& item) {
        resize(size_ + 1);
        items_[size_ - 1] = item;
    }

private:
    static constexpr std::size_t page = 4096, large_page = std::size_t{2} << 20;

    void reserve(std::size_t size) {
        std::size_t const wanted = size * sizeof(T) + bytes_ / 2, unit = wanted < large_page ? page : large_page;
        std::size_t const bytes = (wanted + unit - 1) / unit * unit;
        std::byte* const place = unused(bytes, unit);
        // In one go, so that it stays one mapping, as the next move needs.
        if (items_ != nullptr && ::mremap(items_, bytes_, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, place) == MAP_FAILED) {
            ::munmap(place, bytes);
            throw std::bad_alloc{};
        }
        if (unit == large_page) ::madvise(place, bytes, MADV_HUGEPAGE);   // a wish
        items_ = reinterpret_cast<T*>(place);
        bytes_ = bytes;
    }
    /// Addresses that begin at a multiple of `unit`.
    static std::byte* unused(std::size_t bytes, std::size_t unit) {
        std::size_t const more = unit - page;
        void* const mapped =
            ::mmap(nullptr, bytes + more, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (mapped == MAP_FAILED) throw std::bad_alloc{};
        auto* const begin = static_cast<std::byte*>(mapped);
        std::size_t const before = (unit - reinterpret_cast<std::uintptr_t>(mapped) % unit) % unit;
        if (before > 0) ::munmap(begin, before);
        if (before < more) ::munmap(begin + before + bytes, more - before);
        return begin + before;
    }

    T* items_ = nullptr;
    std::size_t size_ = 0, bytes_ = 0;
};

}   // namespace lore
