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

/// Left free behind long messages, so that who sends them can add a trailer without moving them [bytes].
inline constexpr std::size_t room_for_trailer = 32;

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
/// at most 9 kB, and 9 kB for each further 16 channels.
Bytes pack_deliveries(std::span<Delivery const>);
std::vector<Delivery> unpack_deliveries(std::span<std::byte const>);

/// What distances of a kind compare of a pool's members; other fields of the descriptors stay empty.
struct ComparedPool {
    DistanceKind kind{};
    int ranks = 0;   ///< that measure it: the first so many, rank 0 among them
    std::vector<Descriptors> members;
};
Bytes pack_pool(DistanceKind, int ranks, std::span<Descriptors const* const> members);
/// Bits take the memory of those of the pool before: of many, new memory would cost as much as unpacking.
void unpack_pool(std::span<std::byte const>, ComparedPool&);

/// Rows [first, last) of the distance matrix of a pool, which was sent before under this number.
struct RowRequest {
    int pool = 0, first = 0, last = 0;
};
Bytes pack_rows(RowRequest const&);
RowRequest unpack_rows(std::span<std::byte const>);

/// The distances (i, j), j < i, of those rows, row after row.
Bytes pack_distances(int first, int last, DistanceMatrix const&);
void unpack_distances(std::span<std::byte const>, int first, int last, DistanceMatrix&);

}   // namespace lore
