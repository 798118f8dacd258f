#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lore {

// Frames between Lore and the process of a world: docs/manual/formats.md has their bytes. Numbers are little-endian.

inline constexpr std::uint32_t process_protocol_version = 1;

/// What begins each frame: a tag, a lower-case word filled up with zeros; the batch that is meant, 0 for the world; the
/// bytes that follow.
struct FrameHead {
    static constexpr std::size_t tag_size = 8, size = 16;   ///< [bytes]

    std::string tag;
    std::uint32_t batch = 0, payload = 0;
};
/// Of the first FrameHead::size bytes.
FrameHead read_head(std::span<char const>);
/// The tag as frames have it.
std::string padded_tag(std::string_view tag);

/// Makes one frame.
class FrameWriter {
public:
    FrameWriter(std::string_view tag, std::uint32_t batch);

    FrameWriter& number(std::uint32_t);
    FrameWriter& text(std::string_view);   ///< its length, its bytes
    FrameWriter& floats(std::span<float const>);
    /// The frame, whole.
    std::string_view finish();

private:
    std::string bytes_;
};

/// Reads a payload, item by item. What is read beyond its end is 0 or empty.
class FrameReader {
public:
    explicit FrameReader(std::span<char const> payload) : rest_(payload) {}

    std::uint32_t number();
    float real();
    std::string text();
    void floats(std::span<float>);
    void bytes(std::span<unsigned char>);
    /// Whether what was read is the payload, no more and no less.
    bool exact() const { return !short_ && rest_.empty(); }

private:
    std::span<char const> take(std::size_t count);

    std::span<char const> rest_;
    bool short_ = false;
};

}   // namespace lore
