#include "exact_shape.h"

#include <algorithm>
#include <cmath>

namespace lore::exact {

namespace {

static_assert(most_continuous == most_channels);
constexpr int fewest_block_bits = 12;   ///< a table of 2^12 slots still tells a KB of 24 000 features apart

constexpr int fewest_halved_blocks = 4;   ///< of fewer, a half is hardly more than a block

int most_differing_bits(KnowledgeConfig const& config) {
    double const bits = static_cast<double>(config.window_length) * config.channels.binary_count();
    return static_cast<int>(std::clamp(std::ceil(static_cast<double>(config.squared_threshold())) - 1, 0.0, bits));
}

/// The numbers of a summary or a key: how many values each is the sum of.
using Sizes = std::vector<int>;

/// The scales of `numbers` numbers, 0 for those that sum up nothing, and how far they may differ.
///
/// With x the distance of the sums before rounding and s what rounding can add, the bound is (x + s)^2, which never
/// exceeds (1 + e) x^2 + (1 + 1/e) s^2; with this e it is hardly looser.
SumBound scale_sums(Sizes const& sizes, float* scales) {
    int const largest = sizes.empty() ? 1 : std::max(1, *std::max_element(sizes.begin(), sizes.end()));
    for (std::size_t i = 0; i < sizes.size(); ++i)
        scales[i] = sizes[i] == 0
                        ? 0.0f
                        : static_cast<float>(summary_scale / std::sqrt(static_cast<double>(largest) * sizes[i]));
    constexpr double e = 0.05;
    double const rounding = 0.5 + largest * 0x1p-15;   // of one number, sum and quantization
    double const slack = 2 * rounding * std::sqrt(static_cast<double>(sizes.size()));
    double const scale = static_cast<double>(summary_scale) * summary_scale / largest;
    return {static_cast<float>((1 + e) * scale), static_cast<float>((1 + 1 / e) * slack * slack + 1)};
}

/// Of the sums of all channels and blocks, dealt out to so many numbers in turn.
Sizes dealt_out(Shape const& shape, int numbers) {
    Sizes sizes(static_cast<std::size_t>(std::min(shape.blocks * shape.continuous, numbers)));
    for (int i = 0; i < shape.blocks * shape.continuous; ++i) {
        int const block = i / shape.continuous;
        sizes[static_cast<std::size_t>(i % numbers)] += shape.block_starts[block + 1] - shape.block_starts[block];
    }
    return sizes;
}

void shape_sums(Shape& shape) {
    int const channels = shape.continuous;
    shape.blocks = channels == 0 ? 0 : std::max(1, summary_size / channels);
    for (int block = 0; block <= shape.blocks; ++block)   // the first block is the longest
        shape.block_starts[block] =
            shape.blocks == 0 ? 0 : (block * shape.window_length + shape.blocks - 1) / shape.blocks;
    shape.summary_bound = scale_sums(dealt_out(shape, summary_size), shape.scales);
    shape.key_bound = scale_sums(dealt_out(shape, key_size), shape.key_scales);
}

/// [part][word]: the bits of the blocks b with b mod `parts` equal to the part.
std::vector<std::uint64_t> masks_of_parts(Shape const& shape, int parts) {
    std::vector<std::uint64_t> masks(static_cast<std::size_t>(parts * shape.words), 0);
    for (int bit = 0; bit < shape.window_length * shape.binary; ++bit) {
        int const part = bit % shape.tables % parts;
        masks[static_cast<std::size_t>(part * shape.words + bit / 64)] |= std::uint64_t{1} << (bit % 64);
    }
    return masks;
}

}   // namespace

Kernel kernel_of(Isa isa) { return kernel_for(isa, LORE_KERNELS(kernel))(); }

Shape shape_of(KnowledgeConfig const& config) {
    Shape shape{};
    shape.window_length = config.window_length;
    shape.step_words = config.channels.words();
    shape.binary = config.channels.binary_count();
    shape.continuous = config.channels.continuous_count();
    int const bits = config.window_length * shape.binary;
    shape.words = (bits + 63) / 64;
    shape.most_differing = most_differing_bits(config);
    shape.hashes = bits / (shape.most_differing + 1) >= fewest_block_bits;
    shape.tables = shape.hashes ? shape.most_differing + 1 : 1;
    shape.halves = shape.tables >= fewest_halved_blocks;
    shape.squared_threshold = config.squared_threshold();
    shape.relative_error = static_cast<float>((shape.continuous * config.window_length / 16.0 + 10) * 0x1p-23);
    int const values = shape.continuous * config.window_length;
    constexpr int line = 64;
    shape.code_size = values == 0 ? 0 : (values + static_cast<int>(sizeof(float)) + line - 1) / line * line;
    shape.code_slack = static_cast<float>(std::sqrt(static_cast<double>(values)) * 0x1p-22);
    shape_sums(shape);
    return shape;
}

std::vector<std::uint64_t> masks_of(Shape const& shape) {
    if (!shape.hashes) return std::vector<std::uint64_t>(static_cast<std::size_t>(shape.words), 0);
    return masks_of_parts(shape, shape.tables);
}

std::vector<std::uint64_t> growing_masks_of(Shape const& shape) {
    std::vector<std::uint64_t> masks = shape.halves ? masks_of_parts(shape, 2) : std::vector<std::uint64_t>{};
    auto const blocks = masks_of(shape);
    masks.insert(masks.end(), blocks.begin(), blocks.end());
    return masks;
}

std::vector<std::int32_t> limits_of(Shape const& shape) {
    std::vector<std::int32_t> limits;
    for (int differing = 0; differing <= shape.most_differing; ++differing)
        limits.push_back(shape.summary_bound.largest(shape.squared_threshold * (1 + shape.relative_error) -
                                                     static_cast<float>(differing)));
    return limits;
}

}   // namespace lore::exact
