#pragma once

#include <lore/network/genome.h>
#include <lore/world/open.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace lore {

/// The world of a stored run, lineage or knowledge base: what it takes to tell whether another one is the same.
///
/// A text that is empty, a number that is 0 and channels of which there are none were not recorded (files of format
/// version 1, what was derived from a knowledge base) and differ from nothing. Files with genomes or windows always
/// have the channels.
struct WorldRecord {
    std::string name, task, reward_unit;
    Channels channels;
    int outcome_size = 0;
    float width = 0, height = 0;   ///< [u]
    // Of a world of foreign code:
    std::string file;             ///< the file's name, without its folder
    std::uint64_t checksum = 0;   ///< of that file
    std::string settings;         ///< as WorldOrigin has them

    Interface interface() const { return Interface{channels}; }
    friend bool operator==(WorldRecord const&, WorldRecord const&) = default;
};

WorldRecord world_record(WorldFacts const&, WorldOrigin const& = {});

/// A JSON object (docs/manual/formats.md).
std::string to_json(WorldRecord const&);
/// Throws std::out_of_range with the reason where it is none, or breaks a bound of world/facts.h.
WorldRecord parse_world_record(std::string_view json);

/// In one phrase, how the world of a stored file differs from the present one, or ""; what belongs to a run must have
/// the same world, task and build of its library. Controllers and knowledge need no more than the same channels:
/// why_misfit (world/channels.h).
std::string why_other(WorldRecord const& stored, WorldRecord const& present);

}   // namespace lore
