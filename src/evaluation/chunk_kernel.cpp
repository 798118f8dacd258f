#include "chunk_kernel.h"

#include <lore/core/lanes.h>

namespace lore::LORE_ISA_NAMESPACE {

namespace {

constexpr int width = LORE_LANES;
using F = Lanes<float, width>;
using I = Lanes<std::int32_t, width>;
/// A lane counts its ten bins in fields of three bits, and every seven steps moves them, the even and the odd ones
/// apart, to fields of six bits, which hold 63 steps.
constexpr int narrow_bits = 3, wide_bits = 6;
constexpr int narrow_steps = 7, wide_steps = 63;
constexpr std::int32_t even_fields = 07'07'07'07'07;
static_assert(tally_bins * narrow_bits <= 31 && tally_bins / 2 * wide_bits <= 31);

/// 1 in the narrow field of the bin.
LORE_INLINE I one_in_field(I const& bin) {
#if defined(__AVX512F__)
    I const table{1, 1 << 3, 1 << 6, 1 << 9, 1 << 12, 1 << 15, 1 << 18, 1 << 21, 1 << 24, 1 << 27};
    return (I)_mm512_maskz_permutexvar_epi32(0xffff, (__m512i)bin, (__m512i)table);
#elif defined(__AVX2__)
    return (I{} + 1) << (bin + bin + bin);
#else
    // Without shifts by lane: the float 2^(3 bin), converted.
    return lanes::truncate(lanes::cast_bits<F>((bin + bin + bin + 127) << 23));
#endif
}

void tally_some(float const* values, int steps, int channels, int lanes, int at, LaneTally* tallies) {
    std::ptrdiff_t const row = static_cast<std::ptrdiff_t>(channels) * lanes;
    for (int channel = 0; channel < channels; ++channel) {
        I even{}, odd{};
        float const* column = values + channel * lanes + at;
        for (int done = 0; done < steps;) {
            I narrow{};
            for (int const until = steps - done < narrow_steps ? steps : done + narrow_steps; done < until;
                 ++done, column += row)
                narrow += one_in_field(lanes::truncate(F(lanes::load<F>(column) * 9.99f)));   // entropy_bin
            even += narrow & even_fields;
            odd += narrow >> narrow_bits & even_fields;
        }
        for (int bin = 0; bin < tally_bins; ++bin) {
            auto* const counts = tallies[channel].counts[bin] + at;
            I const field = (bin % 2 == 0 ? even : odd) >> (bin / 2 * wide_bits) & wide_steps;
            lanes::store(counts, lanes::load<I>(counts) + field);
        }
    }
}

void tally_chunk(float const* values, int steps, int channels, int lanes, LaneTally* tallies) {
    for (int done = 0; done < steps; done += wide_steps)
        for (int at = 0; at < lanes; at += width)
            tally_some(values + static_cast<std::ptrdiff_t>(done) * channels * lanes,
                       steps - done < wide_steps ? steps - done : wide_steps, channels, lanes, at, tallies);
}

void transpose_words(std::uint16_t const* words, int rows, int lanes, std::uint16_t* const* out) {
    for (int lane = 0; lane < lanes; ++lane) {
        std::uint16_t* const to = out[lane];
        for (int row = 0; row < rows; ++row) to[row] = words[row * lanes + lane];
    }
}

/// Adds to the counts of the lowest `bits` bits; a template, so that the sums stay in registers.
template <int bits>
void count_adjacent(std::uint16_t const* words, int count, std::uint32_t* ones) {
    constexpr int at_once = 2 * width;
    using Words = Lanes<std::uint16_t, at_once>;
    int done = 0;
    while (count - done >= at_once) {
        // A 16-bit sum holds the ones of 65535 vectors.
        int const vectors = (count - done) / at_once < 65535 ? (count - done) / at_once : 65535;
        Words sums[bits] = {};
        for (int v = 0; v < vectors; ++v, done += at_once) {
            Words const here = lanes::load<Words>(words + done);
            for (int bit = 0; bit < bits; ++bit) sums[bit] += here >> bit & 1;
        }
        for (int bit = 0; bit < bits; ++bit)
            for (int lane = 0; lane < at_once; ++lane) ones[bit] += sums[bit][lane];
    }
    for (; done < count; ++done)
        for (int bit = 0; bit < bits; ++bit) ones[bit] += words[done] >> bit & 1u;
}

using CountAdjacent = void(std::uint16_t const* words, int count, std::uint32_t* ones);
template <int most>
CountAdjacent* count_adjacent_for(int bits) {
    if constexpr (most > 1)
        if (bits < most) return count_adjacent_for<most - 1>(bits);
    return count_adjacent<most>;
}

void count_ones(std::uint16_t const* words, int count, int stride, int bits, std::uint32_t* ones) {
    CountAdjacent* const count_some = count_adjacent_for<16>(bits);
    for (int bit = 0; bit < bits; ++bit) ones[bit] = 0;
    if (stride == 1) return count_some(words, count, ones);
    constexpr int most = 1024;
    std::uint16_t gathered[most];
    for (int done = 0; done < count;) {
        int const some = count - done < most ? count - done : most;
        for (int i = 0; i < some; ++i, words += stride) gathered[i] = *words;
        count_some(gathered, some, ones);
        done += some;
    }
}

}   // namespace

ChunkKernel chunk() { return {tally_chunk, transpose_words, count_ones}; }

}   // namespace lore::LORE_ISA_NAMESPACE
