#include "process_frame.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace lore {

namespace {

// By shifts, which compilers turn into one load or store where the machine has this order.
void store(char* to, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) to[i] = static_cast<char>(value >> (8 * i) & 0xff);
}

std::uint32_t load(char const* from) {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(static_cast<unsigned char>(from[i])) << (8 * i);
    return value;
}

}   // namespace

std::string padded_tag(std::string_view tag) {
    std::string padded{tag};
    padded.resize(FrameHead::tag_size, '\0');
    return padded;
}

FrameHead read_head(std::span<char const> bytes) {
    std::string_view const tag{bytes.data(), FrameHead::tag_size};
    return {std::string{tag.substr(0, tag.find('\0'))}, load(bytes.data() + 8), load(bytes.data() + 12)};
}

FrameWriter::FrameWriter(std::string_view tag, std::uint32_t batch) : bytes_(padded_tag(tag)) {
    number(batch).number(0);
}

FrameWriter& FrameWriter::number(std::uint32_t value) {
    bytes_.resize(bytes_.size() + 4);
    store(bytes_.data() + bytes_.size() - 4, value);
    return *this;
}

FrameWriter& FrameWriter::text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
}

FrameWriter& FrameWriter::floats(std::span<float const> values) {
    std::size_t const before = bytes_.size();
    bytes_.resize(before + 4 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        store(bytes_.data() + before + 4 * i, std::bit_cast<std::uint32_t>(values[i]));
    return *this;
}

std::string_view FrameWriter::finish() {
    store(bytes_.data() + 12, static_cast<std::uint32_t>(bytes_.size() - FrameHead::size));
    return bytes_;
}

std::span<char const> FrameReader::take(std::size_t count) {
    if (rest_.size() < count) {
        short_ = true;
        rest_ = {};
        return {};
    }
    auto const taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
}

std::uint32_t FrameReader::number() {
    auto const bytes = take(4);
    return bytes.empty() ? 0 : load(bytes.data());
}

float FrameReader::real() { return std::bit_cast<float>(number()); }

std::string FrameReader::text() {
    auto const bytes = take(number());
    return {bytes.begin(), bytes.end()};
}

void FrameReader::floats(std::span<float> values) {
    auto const bytes = take(4 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = bytes.empty() ? 0 : std::bit_cast<float>(load(bytes.data() + 4 * i));
}

void FrameReader::bytes(std::span<unsigned char> values) {
    auto const bytes = take(values.size());
    std::ranges::fill(values, 0);
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
}

}   // namespace lore
