#include "chunk_kernel.h"

#include <lore/core/lanes.h>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

constexpr int width = LORE_LANES;
using F = Lanes<float, width>;
using I = Lanes<std::int32_t, width>;
/// Half as many lanes of twice the size: one native vector.
constexpr int half = width / 2;
using HalfInts = Lanes<std::int32_t, half>;
using Fields = Lanes<std::uint64_t, half>;

/// Ten counters of six bits fit one 64-bit lane, so they must be emptied after 63 steps.
constexpr int field_bits = 6;
constexpr int most_steps = (1 << field_bits) - 1;
static_assert(tally_bins * field_bits <= 64);

void tally_some(float const* values, int steps, int lanes, int at, LaneTally& tally) {
    Fields const one = Fields{} + 1;
    for (int channel = 0; channel < tally_channels; ++channel) {
        Fields low{}, high{};
        float const* column = values + channel * lanes + at;
        for (int step = 0; step < steps; ++step, column += tally_channels * lanes) {
            I const bin = lanes::truncate(F(lanes::load<F>(column) * 9.99f));   // entropy_bin
            I const shift = bin * field_bits;
            HalfInts const shift_low = lanes::load<HalfInts>(reinterpret_cast<char const*>(&shift));
            HalfInts const shift_high = lanes::load<HalfInts>(reinterpret_cast<char const*>(&shift) + sizeof(HalfInts));
            low += one << __builtin_convertvector(shift_low, Fields);
            high += one << __builtin_convertvector(shift_high, Fields);
        }
        for (int bin = 0; bin < tally_bins; ++bin) {
            auto* counts = tally.counts[channel][bin] + at;
            for (int lane = 0; lane < half; ++lane) {
                counts[lane] += static_cast<std::uint32_t>(low[lane] >> (bin * field_bits) & most_steps);
                counts[half + lane] += static_cast<std::uint32_t>(high[lane] >> (bin * field_bits) & most_steps);
            }
        }
    }
}

void tally_chunk(float const* values, int steps, int lanes, LaneTally& tally) {
    for (int done = 0; done < steps; done += most_steps)
        for (int at = 0; at < lanes; at += width)
            tally_some(values + done * tally_channels * lanes, steps - done < most_steps ? steps - done : most_steps, lanes, at, tally);
}

void transpose_values(float const* values, int columns, int lanes, float* out) {
    for (int lane = 0; lane < lanes; ++lane)
        for (int column = 0; column < columns; ++column) out[lane * columns + column] = values[column * lanes + lane];
}

void transpose_words(std::uint16_t const* words, int steps, int lanes, std::uint16_t* const* out) {
    for (int lane = 0; lane < lanes; ++lane) {
        std::uint16_t* const to = out[lane];
        for (int step = 0; step < steps; ++step) to[step] = words[step * lanes + lane];
    }
}

void count_ones(std::uint16_t const* words, int count, std::uint32_t (&ones)[9]) {
    constexpr int at_once = 2 * width;
    using Words = Lanes<std::uint16_t, at_once>;
    for (std::uint32_t& n : ones) n = 0;
    int done = 0;
    while (count - done >= at_once) {
        // A 16-bit sum holds the ones of 65535 vectors.
        int const vectors = (count - done) / at_once < 65535 ? (count - done) / at_once : 65535;
        Words sums[9] = {};
        for (int v = 0; v < vectors; ++v, done += at_once) {
            Words const here = lanes::load<Words>(words + done);
            for (int bit = 0; bit < 9; ++bit) sums[bit] += here >> bit & 1;
        }
        for (int bit = 0; bit < 9; ++bit)
            for (int lane = 0; lane < at_once; ++lane) ones[bit] += sums[bit][lane];
    }
    for (; done < count; ++done)
        for (int bit = 0; bit < 9; ++bit) ones[bit] += words[done] >> bit & 1u;
}

} // namespace

extern ChunkKernel const chunk_kernel{tally_chunk, transpose_values, transpose_words, count_ones};

} // namespace lore::LORE_ISA_NAMESPACE
