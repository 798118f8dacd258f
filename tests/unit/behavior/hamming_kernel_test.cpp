#include "hamming_kernel.h"

#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <vector>

using namespace lore;

namespace {

/// All kernels that this machine can run.
std::vector<HammingKernel> kernels() {
    std::vector<HammingKernel> all;
    for (int isa = 0; isa <= static_cast<int>(detected_isa()); ++isa)
        for (bool const by_instruction : {false, true})
            all.push_back(kernel_for(static_cast<Isa>(isa), LORE_KERNELS(hamming))(by_instruction));
    return all;
}

std::vector<std::uint64_t> random_words(Stream& rng, std::size_t count) {
    std::vector<std::uint64_t> words(count);
    for (std::uint64_t& word : words) word = rng.below(4) == 0 ? ~std::uint64_t{0} : rng.bits64();
    return words;
}

}   // namespace

TEST(HammingKernel, counts_differing_bits_of_planes_in_every_lane) {
    Stream rng{18, Purpose::test};
    for (HammingKernel const& kernel : kernels()) {
        for (int const groups : {1, 3}) {
            std::vector<std::uint64_t> const plane = random_words(rng, words_per_plane);
            std::vector<std::uint64_t> const others =
                random_words(rng, static_cast<std::size_t>(groups * kernel.lanes * words_per_plane));
            std::vector<std::uint32_t> counts(static_cast<std::size_t>(groups * kernel.lanes));
            kernel.differing(plane.data(), others.data(), groups, counts.data());
            for (int k = 0; k < groups * kernel.lanes; ++k) {
                int expected = 0;
                for (int word = 0; word < words_per_plane; ++word)
                    expected += std::popcount(
                        plane[word] ^
                        others[(k / kernel.lanes * words_per_plane + word) * kernel.lanes + k % kernel.lanes]);
                ASSERT_EQ(counts[k], static_cast<std::uint32_t>(expected)) << kernel.lanes << " lanes";
            }
        }
    }
}

TEST(HammingKernel, counts_none_and_all) {
    for (HammingKernel const& kernel : kernels()) {
        std::vector<std::uint64_t> const zeros(words_per_plane * kernel.lanes),
            ones(words_per_plane * kernel.lanes, ~std::uint64_t{0});
        std::vector<std::uint32_t> counts(kernel.lanes);
        kernel.differing(zeros.data(), ones.data(), 1, counts.data());
        EXPECT_EQ(counts, std::vector<std::uint32_t>(kernel.lanes, steps_per_plane));
        kernel.differing(ones.data(), ones.data(), 1, counts.data());
        EXPECT_EQ(counts, std::vector<std::uint32_t>(kernel.lanes, 0));
    }
}

TEST(HammingKernel, splits_steps_into_planes_in_one_order_of_steps_for_all_channels) {
    Stream rng{19, Purpose::test};
    std::vector<std::uint16_t> steps(steps_per_plane);
    for (std::uint16_t& word : steps) word = static_cast<std::uint16_t>(rng.below(1u << 16));
    constexpr std::ptrdiff_t stride = words_per_plane + 3;
    auto const column = [](std::vector<std::uint64_t> const& planes, int bit) {
        std::uint16_t word = 0;
        for (int channel = 0; channel < channels_of_word; ++channel)
            word =
                static_cast<std::uint16_t>(word | (planes[channel * stride + bit / 64] >> (bit % 64) & 1u) << channel);
        return word;
    };
    for (HammingKernel const& kernel : kernels()) {
        std::vector<std::uint64_t> planes(channels_of_word * stride);
        // Each step alone finds its place; then all together must be found in their places.
        std::vector<int> place(steps_per_plane, -1);
        for (int step = 0; step < steps_per_plane; ++step) {
            std::vector<std::uint16_t> alone(steps_per_plane);
            alone[step] = 1u << 7;
            kernel.split(alone.data(), planes.data(), stride, channels_of_word);
            for (int bit = 0; bit < steps_per_plane; ++bit)
                if (column(planes, bit) != 0) place[step] = place[step] == -1 ? bit : -2;
            ASSERT_GE(place[step], 0) << "step " << step;
        }
        kernel.split(steps.data(), planes.data(), stride, channels_of_word);
        for (int step = 0; step < steps_per_plane; ++step) ASSERT_EQ(column(planes, place[step]), steps[step]);
    }
}

TEST(HammingKernel, splits_off_the_wanted_channels_alone) {
    Stream rng{20, Purpose::test};
    std::vector<std::uint16_t> steps(steps_per_plane);
    for (std::uint16_t& word : steps) word = static_cast<std::uint16_t>(rng.below(1u << 16));
    for (HammingKernel const& kernel : kernels()) {
        std::vector<std::uint64_t> all(channels_of_word * words_per_plane);
        kernel.split(steps.data(), all.data(), words_per_plane, channels_of_word);
        for (int channels = 1; channels < channels_of_word; ++channels) {
            std::vector<std::uint64_t> some(all.size(), 5), expected = some;
            std::copy_n(all.begin(), channels * words_per_plane, expected.begin());
            kernel.split(steps.data(), some.data(), words_per_plane, channels);
            ASSERT_EQ(some, expected) << channels << " channels";
        }
    }
}
