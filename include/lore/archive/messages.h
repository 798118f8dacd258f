#pragma once

#include <lore/archive/container.h>
#include <lore/behavior/distance_matrix.h>
#include <lore/evaluation/evaluation.h>

#include <span>
#include <vector>

namespace lore {

/// What ranks say to each other, as bytes: one flat copy each way, no cost per value. Both ends run the same program on
/// processors of one byte order, so that numbers travel as they lie in memory; Readers throw Error on bytes that no
/// writer wrote.

/// Precondition: all have one interface.
Bytes pack_genomes(std::span<Genome const* const>);
std::vector<Genome> unpack_genomes(std::span<std::byte const>);

/// What became of the genome with this ticket.
struct Delivery {
    int ticket = 0;
    Evaluation evaluation;
    friend bool operator==(Delivery const&, Delivery const&) = default;
};
/// One of 4000 steps and up to 16 channels takes 1 to 2 kB, since most steps repeat the Hamming bits of the one before;
/// at most 8.4 kB, and 8 kB for each further 16 channels.
Bytes pack_deliveries(std::span<Delivery const>);
std::vector<Delivery> unpack_deliveries(std::span<std::byte const>);

/// Rows [first, last) of a matrix of trajectory distances, and the paths of pool members 0 .. last-1 that they need.
struct RowRequest {
    int first = 0, last = 0;
    std::vector<Descriptors> pool;   ///< paths only
};
Bytes pack_rows(int first, int last, std::span<Descriptors const* const> pool);
RowRequest unpack_rows(std::span<std::byte const>);

/// The distances (i, j), j < i, of those rows, row after row.
Bytes pack_distances(int first, int last, DistanceMatrix const&);
void unpack_distances(std::span<std::byte const>, int first, int last, DistanceMatrix&);

}   // namespace lore
