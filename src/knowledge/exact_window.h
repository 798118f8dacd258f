#pragma once

#include "exact_kernel.h"

#include <lore/core/lanes.h>

#if defined(__BMI2__)
#include <immintrin.h>
#endif

// What a kernel makes of a window: its pattern, its summary and its key.
namespace lore::exact {

/// The binary channels of four steps of one word each.
LORE_INLINE std::uint64_t four_steps(std::uint16_t const* bits, int binary) {
    std::uint64_t const channels = (std::uint64_t{1} << binary) - 1;
#if defined(__BMI2__)
    return _pext_u64(lanes::load<std::uint64_t>(bits), channels * 0x0001000100010001u);
#else
    return (bits[0] & channels) | (bits[1] & channels) << binary | (bits[2] & channels) << 2 * binary |
           (bits[3] & channels) << 3 * binary;
#endif
}

/// Puts `size` bits, the others of `pattern` being 0, at bit `at`.
LORE_INLINE void place(std::uint64_t* words, std::uint64_t pattern, int at, int size) {
    words[at / 64] |= pattern << (at % 64);
    if (at % 64 + size > 64) words[at / 64 + 1] |= pattern >> (64 - at % 64);
}

/// Steps of any number of words, of which the last may be without binary channels.
LORE_INLINE void pack_word_by_word(Shape const& shape, std::uint16_t const* bits, std::uint64_t* words) {
    int at = 0;
    for (int step = 0; step < shape.window_length; ++step, bits += shape.step_words)
        for (int first = 0; first < shape.binary; first += 16) {
            int const size = shape.binary - first < 16 ? shape.binary - first : 16;
            place(words, bits[first / 16] & ((std::uint64_t{1} << size) - 1), at, size);
            at += size;
        }
}

LORE_INLINE void pack_window(Shape const& shape, std::uint16_t const* bits, std::uint64_t* words) {
    for (int word = 0; word < shape.words; ++word) words[word] = 0;
    int const binary = shape.binary;
    if (binary == 0) return;
    if (shape.step_words > 1) return pack_word_by_word(shape, bits, words);
    int step = 0;
    for (; step + 4 <= shape.window_length; step += 4)
        place(words, four_steps(bits + step, binary), step * binary, 4 * binary);
    for (; step < shape.window_length; ++step)
        place(words, bits[step] & ((std::uint64_t{1} << binary) - 1), step * binary, binary);
}

/// [block][channel]: the sums of each continuous channel over the steps of each block.
using Sums = float[most_continuous];

/// `parts` parts of four channels, of which the last may overlap the one before.
template <int parts>
LORE_INLINE void add_up_by_four(Shape const& shape, float const* values, float* sums) {
    using Four = Lanes<float, 4>;
    int const channels = shape.continuous;
    auto const start = [&](int part) { return part < parts - 1 ? 4 * part : channels - 4; };
    for (int block = 0; block < shape.blocks; ++block, sums += channels) {
        Four part_sums[parts]{};
        for (int step = shape.block_starts[block]; step < shape.block_starts[block + 1]; ++step)
            for (int part = 0; part < parts; ++part)
                part_sums[part] += lanes::load<Four>(values + step * channels + start(part));
        for (int part = 0; part < parts; ++part) lanes::store(sums + start(part), part_sums[part]);
    }
}

LORE_INLINE void add_up_one_by_one(Shape const& shape, float const* values, float* sums) {
    int const channels = shape.continuous;
    for (int block = 0; block < shape.blocks; ++block, sums += channels) {
        for (int channel = 0; channel < channels; ++channel) sums[channel] = 0;
        for (int step = shape.block_starts[block]; step < shape.block_starts[block + 1]; ++step)
            for (int channel = 0; channel < channels; ++channel) sums[channel] += values[step * channels + channel];
    }
}

LORE_INLINE void add_up(Shape const& shape, float const* values, Sums& sums) {
    if (shape.continuous < 4) return add_up_one_by_one(shape, values, sums);
    switch ((shape.continuous + 3) / 4) {
    case 1: return add_up_by_four<1>(shape, values, sums);
    case 2: return add_up_by_four<2>(shape, values, sums);
    case 3: return add_up_by_four<3>(shape, values, sums);
    default: return add_up_one_by_one(shape, values, sums);
    }
}

/// A value outside 0 .. 1 moves to the edge, which only brings two windows nearer to each other.
LORE_INLINE std::uint8_t quantized(float sum, float scale) {
    float number = sum * scale + 0.5f;
    number = number > 0 ? number : 0;
    number = number < summary_scale ? number : static_cast<float>(summary_scale);
    return static_cast<std::uint8_t>(number);
}

LORE_INLINE void put_summary(Shape const& shape, Sums const& sums, Digest& digest) {
    int const count = shape.blocks * shape.continuous;
    float numbers[summary_size]{};
    if (count <= summary_size)
        for (int i = 0; i < count; ++i) numbers[i] = sums[i];
    else
        for (int channel = 0; channel < count; ++channel) numbers[channel % summary_size] += sums[channel];
    for (int i = 0; i < summary_size; ++i) digest.summary[i] = quantized(numbers[i], shape.scales[i]);
}

LORE_INLINE Key key_of(Shape const& shape, std::uint64_t const* words, Sums const& sums) {
    float numbers[key_size]{};
    int const count = shape.blocks * shape.continuous;
    for (int i = 0; i < count; ++i) numbers[i % key_size] += sums[i];
    Key key{};
    for (int i = 0; i < key_size; ++i) key.sums[i] = quantized(numbers[i], shape.key_scales[i]);
    int ones = 0;
    for (int word = 0; word < shape.words; ++word) ones += __builtin_popcountll(words[word]);
    key.ones = static_cast<std::uint8_t>(ones < 255 ? ones : 255);
    key.feature = -1;
    return key;
}

}   // namespace lore::exact
