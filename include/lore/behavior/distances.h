#pragma once

#include <lore/behavior/descriptors.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace lore {

enum class DistanceKind : std::uint8_t { adhoc, hamming, trajectory, entropy };
inline constexpr int distance_kinds = static_cast<int>(DistanceKind::entropy) + 1;   ///< the last one's number and 1
std::string_view name(DistanceKind);
DistanceKind distance_kind(std::string_view name);   ///< throws UsageError
std::string distance_names();                        ///< of all, with commas between them

/// Behavioral distances d_1..d_4 (paper, "Dynamic behavioral diversity"): symmetric, 0 for equal descriptors. These
/// are the definitions; measure_rows (distance_matrix.h) is the fast twin.

/// Euclidean, over the numbers of the outcome; squares are summed in their order. Precondition: equally many numbers.
double adhoc_distance(Descriptors const&, Descriptors const&);
/// Fraction of the bits, one a channel and step, that differ; a step that only one of the two lived differs in all.
/// Precondition: equally many channels.
double hamming_distance(Descriptors const&, Descriptors const&);
/// Edit distance between tile sequences: insertion = deletion = 1, substitution (|dx| + |dy|) / 12, transposition of
/// neighbors at the substitution cost of the pair. Computed in whole twelfths, so that sums are exact.
double trajectory_distance(Descriptors const&, Descriptors const&);
/// Euclidean, over the entropies of all channels, summed in their order. Precondition: equally many channels.
double entropy_distance(Descriptors const&, Descriptors const&);

double distance(DistanceKind, Descriptors const&, Descriptors const&);

}   // namespace lore
