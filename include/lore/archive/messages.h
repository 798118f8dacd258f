#pragma once

#include <lore/archive/container.h>
#include <lore/behavior/descriptors.h>
#include <lore/behavior/distances.h>
#include <lore/evaluation/evaluation.h>

#include <span>
#include <vector>

namespace lore {

/// What ranks say to each other, as bytes: one flat copy each way, no cost per value. Both ends run the same program on
/// processors of one byte order, so that numbers travel as they lie in memory; Readers throw Error on bytes that no
/// writer wrote.

/// Left free behind distances and bounded messages, so that who sends them can add a trailer without moving them
/// [bytes].
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
/// One of 4000 steps and up to 16 channels takes 1 to 3 kB, since most steps repeat the Hamming bits of the one before;
/// at most 9 kB, and 9 kB for each further 16 channels.
Bytes pack_deliveries(std::span<Delivery const>);
/// In as many messages as it takes for none to be longer than so many bytes; one that is alone in its message may be.
std::vector<Bytes> pack_deliveries(std::span<Delivery const>, std::size_t longest);
std::vector<Delivery> unpack_deliveries(std::span<std::byte const>);

/// A pool whose distances are to be measured, and what distances of this kind compare of its members; other fields of
/// the descriptors stay empty.
struct ComparedPool {
    DistanceKind kind{};
    int known = 0;   ///< distances among the first so many members are known
    std::vector<Descriptors> members;
};
Bytes pack_pool(DistanceKind, int known, std::span<Descriptors const* const> members);
/// Bits take the memory of those of the pool before: of many, new memory would cost as much as unpacking.
void unpack_pool(std::span<std::byte const>, ComparedPool&);

/// What a rank has measured of a pool: rows of its matrix, or means.
Bytes pack_distances(std::span<double const>);
/// Throws Error unless there are just as many as the span has room for.
void unpack_distances(std::span<std::byte const>, std::span<double>);

}   // namespace lore
