#pragma once

#include "exact_kernel.h"

#include <lore/knowledge/window.h>

#include <cstdint>
#include <vector>

// Four bounds let the exact index compute few distances. All follow from the configuration and the channels' kinds.
//
// 1. The squared distance is at least the number of differing bits, in float too: the sum of squares is not negative
//    and the number of bits is added last. So a match differs in at most D bits, D the largest number below the squared
//    threshold (3 for the paper's).
// 2. Cut the bits into D + 1 blocks: two windows that differ in at most D bits agree in at least one block. A hash
//    table per block finds all windows that agree in it ("multi-index hashing", Norouzi et al. 2012). Bit i belongs to
//    block i mod (D + 1): of many partitions tried this one leads to the fewest features, ten times fewer than blocks
//    of whole channels, which change seldom, or of neighboring steps. Blocks of a few bits select nothing; then one
//    bucket holds all features. Where there are four blocks or more, a table per half of them finds with smaller
//    buckets all windows that differ in at most one bit.
// 3. Part a window's continuous values into groups. By Cauchy and Schwarz the squared difference of two sums of m
//    values each is at most m times the sum of the m squared differences. Divide each group's sum by the square root
//    of its m: the squared distance of two windows' sums is then at most that of their values. Sums over one channel
//    and some steps, or over some channels and all steps, differ most: within them values tend to differ alike.
// 4. A window whose values are rounded lies at a known distance from the window (exact_codes.h). By the triangle
//    inequality the distance of two windows lies within both of these of that of their rounded ones.
//
// A group's sum lies between 0 and m. Scaled by 255 / sqrt(M m), M the largest m, and rounded to an integer it fits
// into a byte, and squared distances of such integers are 255^2 / M times those of bound 3. That is rounded three
// times, and the index leaves room for each: the distance in float is off by at most (C T / 16 + 10) 2^-24 of itself, C
// continuous channels; a sum of m values by m 2^-24 of m, in any order; the integers by a half each.
namespace lore::exact {

Shape shape_of(KnowledgeConfig const&);
/// Tables::masks of a final set: the bits of each block, or none if the tables do not hash.
std::vector<std::uint64_t> masks_of(Shape const&);
/// Those of a set that grows: if it has them, the halves before the blocks.
std::vector<std::uint64_t> growing_masks_of(Shape const&);
/// FixedView::limits.
std::vector<std::int32_t> limits_of(Shape const&);

}   // namespace lore::exact
