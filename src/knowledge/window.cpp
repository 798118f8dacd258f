#include <lore/knowledge/window.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace lore {

namespace {

/// Bits in which the windows' binary channels differ.
int differing_bits(Channels const& channels, Window const& a, Window const& b) {
    auto const words = static_cast<std::size_t>(channels.words());
    int differing = 0;
    for (std::size_t word = 0; word < words; ++word) {
        unsigned const mask = binary_mask(channels, static_cast<int>(word));
        if (mask == 0) break;
        for (std::size_t i = word; i < a.bits.size(); i += words)
            differing += std::popcount((static_cast<unsigned>(a.bits[i]) ^ b.bits[i]) & mask);
    }
    return differing;
}

}   // namespace

std::uint16_t binary_mask(Channels const& channels, int word) {
    int const bits = std::clamp(channels.binary_count() - 16 * word, 0, 16);
    return static_cast<std::uint16_t>((1u << bits) - 1);
}

void append_binary_bits(Channels const& channels, Window const& window, std::vector<std::uint16_t>& to) {
    std::size_t const first = to.size();
    to.insert(to.end(), window.bits.begin(), window.bits.end());
    auto const words = static_cast<std::size_t>(channels.words());
    for (std::size_t word = 0; word < words; ++word) {
        std::uint16_t const mask = binary_mask(channels, static_cast<int>(word));
        for (std::size_t i = first + word; i < to.size(); i += words) to[i] &= mask;
    }
}

std::vector<float> channels_at(Channels const& channels, Window const& window, std::size_t step) {
    std::vector<float> values(static_cast<std::size_t>(channels.count()));
    std::uint16_t const* const words = window.bits.data() + step * static_cast<std::size_t>(channels.words());
    std::size_t bit = 0;
    for (int const channel : channels.binary()) {
        values[static_cast<std::size_t>(channel)] = static_cast<float>(words[bit / 16] >> bit % 16 & 1);
        ++bit;
    }
    float const* value = window.values.data() + step * channels.continuous().size();
    for (int const channel : channels.continuous()) values[static_cast<std::size_t>(channel)] = *value++;
    return values;
}

std::vector<Window> windows_of(Trace const& trace, int window_length) {
    assert(window_length >= 1);
    std::span<std::uint16_t const> const bits{trace.channel_bits};
    std::span<float const> const values{trace.values};
    if (bits.empty()) return {};
    std::size_t const words =
                          static_cast<std::size_t>(window_length) * static_cast<std::size_t>(trace.channels.words()),
                      floats = static_cast<std::size_t>(window_length) * trace.channels.continuous().size();
    std::size_t const count = bits.size() / words;
    std::vector<Window> windows;
    windows.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        windows.push_back({bits.subspan(i * words, words), values.subspan(i * floats, floats)});
    return windows;
}

float squared_distance(Channels const& channels, Window const& a, Window const& b) {
    assert(a.bits.size() == b.bits.size() && a.values.size() == b.values.size());
    std::array<float, 16> partial{};
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        float const difference = a.values[i] - b.values[i];
        partial[i % 16] += difference * difference;
    }
    for (std::size_t half = 8; half > 0; half /= 2)
        for (std::size_t i = 0; i < half; ++i) partial[i] += partial[i + half];
    return partial[0] + static_cast<float>(differing_bits(channels, a, b));
}

}   // namespace lore
