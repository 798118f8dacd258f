#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lore {

/// Floats that start at a cache line: a vector load that straddles two lines costs two.
class AlignedFloats {
public:
    /// `count` zeros.
    void assign_zeros(std::size_t count) {
        memory_.assign(count + 16, 0.0f);
        offset_ = (64 - reinterpret_cast<std::uintptr_t>(memory_.data()) % 64) % 64 / sizeof(float);
        count_ = count;
    }
    AlignedFloats() = default;
    AlignedFloats(AlignedFloats const&) = delete;   // a copy would lie elsewhere
    AlignedFloats& operator=(AlignedFloats const&) = delete;

    float* data() { return memory_.data() + offset_; }
    float const* data() const { return memory_.data() + offset_; }
    std::size_t size() const { return count_; }
    float& operator[](std::size_t i) { return data()[i]; }

private:
    std::vector<float> memory_;
    std::size_t offset_ = 0, count_ = 0;
};

}   // namespace lore
