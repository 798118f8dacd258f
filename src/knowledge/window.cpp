#include <lore/knowledge/window.h>

#include <array>
#include <bit>
#include <cassert>

namespace lore {

std::array<float, channel_count> channels_at(Window const& window, std::size_t step) {
    std::array<float, channel_count> channels{};
    for (std::size_t i = 0; i < binary_channels.size(); ++i)
        channels[static_cast<std::size_t>(binary_channels[i])] = static_cast<float>(window.bits[step] >> i & 1);
    for (std::size_t i = 0; i < continuous_channels.size(); ++i)
        channels[static_cast<std::size_t>(continuous_channels[i])] = window.values[step * continuous_count + i];
    return channels;
}

std::vector<Window> windows_of(Trace const& trace, int window_length) {
    assert(window_length >= 1);
    auto const length = static_cast<std::size_t>(window_length);
    std::span<std::uint16_t const> const bits{trace.channel_bits};
    std::span<float const> const values{trace.values};
    std::vector<Window> windows;
    windows.reserve(bits.size() / length);
    for (std::size_t first = 0; first + length <= bits.size(); first += length)
        windows.push_back(
            {bits.subspan(first, length), values.subspan(first * continuous_count, length * continuous_count)});
    return windows;
}

float squared_distance(Window const& a, Window const& b) {
    assert(a.bits.size() == b.bits.size() && a.values.size() == b.values.size());
    std::array<float, 16> partial{};
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        float const difference = a.values[i] - b.values[i];
        partial[i % 16] += difference * difference;
    }
    for (std::size_t half = 8; half > 0; half /= 2)
        for (std::size_t i = 0; i < half; ++i) partial[i] += partial[i + half];

    int differing = 0;
    for (std::size_t step = 0; step < a.bits.size(); ++step)
        differing += std::popcount(static_cast<unsigned>((a.bits[step] ^ b.bits[step]) & window_bits_mask));
    return partial[0] + static_cast<float>(differing);
}

}   // namespace lore
