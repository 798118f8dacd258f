#pragma once

#include <lore/archive/container.h>
#include <lore/core/error.h>

#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace lore {

template <class T>
concept Flat = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

/// Appends values as they lie in memory.
class ByteWriter {
public:
    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
    template <Flat T>
    void put(T const& value) {
        append(&value, sizeof value);
    }
    template <Flat T>
    void put_all(std::span<T const> values) {
        append(values.data(), values.size_bytes());
    }
    /// Little by little: 7 bits a byte, the lowest first.
    void put_varint(std::uint64_t value) {
        for (; value >= 0x80; value >>= 7) bytes_.push_back(static_cast<std::byte>(value | 0x80));
        bytes_.push_back(static_cast<std::byte>(value));
    }
    std::size_t size() const { return bytes_.size(); }
    Bytes const& bytes() const { return bytes_; }
    Bytes take() { return std::move(bytes_); }

private:
    void append(void const* data, std::size_t count) {
        auto const* const first = static_cast<std::byte const*>(data);
        bytes_.insert(bytes_.end(), first, first + count);
    }
    Bytes bytes_;
};

/// Reads what ByteWriter wrote; throws Error where the bytes end too early or a count is more than they can hold.
class ByteReader {
public:
    ByteReader(std::span<std::byte const> bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}

    template <Flat T>
    T get() {
        T value;
        std::memcpy(&value, take(sizeof value), sizeof value);
        return value;
    }
    template <Flat T>
    std::vector<T> get_all(std::size_t count) {
        if (count > rest_.size() / sizeof(T)) fail("it ends too early");
        std::vector<T> values(count);
        get_into(std::span{values});
        return values;
    }
    /// As many as the span has room for.
    template <Flat T>
    void get_into(std::span<T> values) {
        if (values.size() > rest_.size() / sizeof(T)) fail("it ends too early");
        if (!values.empty()) std::memcpy(values.data(), take(values.size_bytes()), values.size_bytes());
    }
    std::uint64_t get_varint() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            auto const byte = get<std::uint8_t>();
            value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
            if ((byte & 0x80) == 0) return value;
        }
        fail("a number has too many digits");
    }
    /// A varint that must not exceed `most`.
    std::size_t get_count(std::size_t most) {
        std::uint64_t const count = get_varint();
        if (count > most) fail("a count is out of range");
        return static_cast<std::size_t>(count);
    }
    std::size_t left() const { return rest_.size(); }
    bool at_end() const { return rest_.empty(); }
    void expect_end() const {
        if (!at_end()) fail("more follows than expected");
    }
    [[noreturn]] void fail(std::string const& reason) const {
        throw Error("cannot read " + name_, reason, "Take a copy that is whole, or make it again.");
    }

private:
    std::byte const* take(std::size_t count) {
        if (count > rest_.size()) fail("it ends too early");
        std::byte const* const start = rest_.data();
        rest_ = rest_.subspan(count);
        return start;
    }
    std::span<std::byte const> rest_;
    std::string name_;
};

}   // namespace lore
