#pragma once

#include <bit>
#include <cstdint>
#include <string>

namespace lore {

/// One number that proves that nothing changed: a running 64-bit digest of the ids and objectives of all generations.
///
/// Order matters. The value is plain state, so that a checkpoint can keep it.
class Signature {
public:
    Signature() = default;
    explicit Signature(std::uint64_t value) : value_(value) {}

    void add(std::uint64_t word) {
        value_ ^= word + 0x9e3779b97f4a7c15u + (value_ << 6) + (value_ >> 2);
        value_ ^= value_ >> 30;
        value_ *= 0xbf58476d1ce4e5b9u;
        value_ ^= value_ >> 27;
        value_ *= 0x94d049bb133111ebu;
        value_ ^= value_ >> 31;
    }
    /// By bit pattern, so that the last bit counts.
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

    std::uint64_t value() const { return value_; }
    /// 16 lower-case hexadecimal digits.
    std::string text() const;

private:
    std::uint64_t value_ = 0;
};

}   // namespace lore
