#pragma once

#include <lore/archive/world_record.h>
#include <lore/evolution/evolution.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lore {

/// Every individual that a run ever evaluated (`--archive all`): a file that only grows, frame after frame.
///
/// A frame holds the generations since the last one; a child is written as its difference from its parent (about 30
/// bytes), and each generation says which individuals survived it, so that writer and reader alike keep one population
/// and no more. Each frame has its own lengths and a checksum that runs on from frame to frame: none can be changed,
/// lost or swapped unnoticed. Where frames end depends on their content alone, so that a resumed run writes the same
/// bytes.

/// Where a file stands; what a checkpoint keeps of it.
struct AllIndividualsMark {
    std::uint64_t bytes = 0;         ///< length of the file
    std::uint64_t chain = 0;         ///< running checksum at that place
    std::uint32_t generations = 0;   ///< gathered, but not in a frame yet
    std::vector<std::byte> gathered;
};

class AllIndividualsWriter {
public:
    /// Starts a new file. Precondition: the genomes to come have the world's interface.
    AllIndividualsWriter(std::string path, WorldRecord const&);
    /// Goes on after a checkpoint: cuts the file back to the mark, with the population of that moment. Throws Error if
    /// the file is shorter.
    AllIndividualsWriter(std::string path, AllIndividualsMark const&, Population const&);
    ~AllIndividualsWriter();

    /// Call it for every generation in order. Writes a frame when enough has gathered.
    void add(GenerationReport const&);
    /// Makes the frames so far durable and says where the file stands.
    AllIndividualsMark mark();
    /// Writes what has gathered as the last frame.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

struct ArchivedIndividual {
    IndividualId id;
    std::optional<IndividualId> parent;   ///< none for founders
    Genome const& genome;                 ///< valid during the call
    double reward = 0;
};

/// Calls back for every individual in order of birth, up to and including generation `through`; memory is bounded by
/// two populations and a frame. Throws Error: missing, damaged, or ending before that generation.
void for_each_individual(std::string const& path, int through, std::function<void(ArchivedIndividual const&)> const&);

/// Generations and individuals of a file, all frames checked. Throws Error.
struct AllIndividualsSummary {
    int generations = 0;
    std::uint64_t individuals = 0;
    std::uint64_t bytes = 0;
    WorldRecord world;
};
AllIndividualsSummary check_all_individuals(std::string const& path);

}   // namespace lore
