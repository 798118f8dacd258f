#pragma once

// What is in a stored file, as text: two files that say the same hold the same.

#include <lore/archive/all_individuals.h>
#include <lore/archive/checkpoint.h>
#include <lore/archive/founders_file.h>
#include <lore/archive/genome_file.h>
#include <lore/archive/knowledge_export.h>
#include <lore/archive/knowledge_file.h>
#include <lore/archive/lineage_file.h>
#include <lore/core/checksum.h>

#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore::test {

inline std::string told(IndividualId id) { return fmt::format("{}.{}", id.generation, id.slot); }

inline std::string told(Genome const& genome) {
    std::string genes;
    for (Edge const& edge : genome.edges) genes += fmt::format("{} {} {:a}\n", edge.source, edge.target, edge.weight);
    for (float const bias : genome.biases) genes += fmt::format("{:a}\n", bias);
    return fmt::format("{} edges {} biases {}", genome.edges.size(), genome.biases.size(),
                       checksum_text(checksum(genes)));
}

/// Nothing of a file of version 1, which says nothing of it.
inline std::string told(WorldRecord const& world) { return world.name.empty() ? "" : to_json(world) + "\n"; }

inline std::string told(Birth const& birth, WorldRecord const& world) {
    return fmt::format("{} from {}: {} {}, shaping {}, diversity {}, {}\n", told(birth.id),
                       birth.parent ? told(birth.parent->id) : "nobody", birth.reward, world.reward_unit, birth.shaping,
                       birth.diversity, told(birth.genome));
}

inline std::string lineage_told(std::string const& path) {
    LineageArchive const lineage = read_lineage(path);
    std::string story = told(lineage.world);
    story += fmt::format("generation {}, best {}, last", lineage.generation, told(lineage.best));
    for (IndividualId const id : lineage.last_population) story += fmt::format(" {}", told(id));
    story += "\n";
    for (auto const& birth : lineage.births) story += told(*birth, lineage.world);
    return story;
}

inline std::string told(Individual const& member, WorldRecord const& world) {
    Descriptors const& descriptors = *member.descriptors;
    std::string values;
    for (float const value : descriptors.outcome) values += fmt::format("{:a} ", value);
    values += fmt::format("{} ", fmt::join(descriptors.channel_bits, " "));
    for (Tile const tile : descriptors.path) values += fmt::format("{}/{} ", tile.x, tile.y);
    for (double const entropy : descriptors.entropies) values += fmt::format("{:a} ", entropy);
    return fmt::format("{} objectives {} {} {}, diversity {}, crowding {}, {} balls {} bits {} tiles {}\n",
                       member.objectives.count, member.objectives.value[0], member.objectives.value[1],
                       member.objectives.value[2], member.diversity, member.crowding, descriptors.outcome.size() / 2,
                       descriptors.channel_bits.size(), descriptors.path.size(), checksum_text(checksum(values))) +
           told(*member.birth, world);
}

inline std::string checkpoint_told(std::string const& path) {
    Checkpoint const checkpoint = unpack_checkpoint(read_container(path, FileKind::checkpoint), path);
    AllIndividualsMark const& mark = checkpoint.all_individuals;
    std::string story = told(checkpoint.world);
    story += fmt::format("seed {} digest {} evaluations {} steps {} seconds {} progress {} signature "
                         "{}\nall: {} bytes, chain {}, {} generations, gathered {}\n",
                         checkpoint.seed, checkpoint.config_digest, checkpoint.evaluations, checkpoint.steps,
                         checkpoint.seconds, checkpoint.progress_bytes, checkpoint.state.signature.text(), mark.bytes,
                         mark.chain, mark.generations, checksum_text(checksum(mark.gathered)));
    Population const& population = checkpoint.state.population;
    story += fmt::format("generation {} by {}\n", population.generation, name(population.distance_kind));
    for (Individual const& member : population.members) story += told(member, checkpoint.world);
    return story;
}

inline std::string all_told(std::string const& path) {
    AllIndividualsSummary const summary = check_all_individuals(path);
    std::string story = told(summary.world);
    story += fmt::format("{} generations, {} individuals\n", summary.generations, summary.individuals);
    for_each_individual(path, summary.generations - 1, [&](ArchivedIndividual const& one) {
        story += fmt::format("{} from {}: {} {}, {}\n", told(one.id), one.parent ? told(*one.parent) : "nobody",
                             one.reward, summary.world.reward_unit, told(one.genome));
    });
    return story;
}

/// With the world where `provenance` is of the whole base.
inline std::string knowledge_told(KnowledgeBase const& base, std::string const& provenance) {
    KnowledgeBase::Parts const& parts = base.parts();
    return fmt::format("windows of {}, threshold {}\n{}\n", base.config().window_length, base.config().match_threshold,
                       provenance) +
           fmt::format("{}\n{}\n{}\n{}\n{}\n", fmt::join(parts.bits, " "), fmt::join(parts.windows, " "),
                       fmt::join(parts.values, " "), fmt::join(parts.reward_sums, " "), fmt::join(parts.counts, " "));
}
inline std::string knowledge_told(std::string const& path) {
    KnowledgeBase const base = read_knowledge_base(path);
    return knowledge_told(base, provenance_json(base));
}
/// Of a base of layout 1, which says nothing of its world.
inline std::string knowledge_told_of_version_1(std::string const& path) {
    KnowledgeBase const base = read_knowledge_base(path);
    return knowledge_told(base, provenance_json(base.provenance()));
}

inline std::string genome_told(std::string const& path) {
    FailedIndividual const failed = read_genome(path);
    return told(failed.world) +
           fmt::format("{} on rank {}: {}, {}\n", told(failed.id), failed.rank, failed.reason, told(failed.genome));
}

inline std::string founders_told(std::string const& path) {
    FoundersFile const founders = read_founders(path);
    std::string story = told(founders.world);
    story += fmt::format("{}\n{}\n", founders.kind, founders.origin);
    for (Genome const& genome : founders.genomes) story += told(genome) + "\n";
    return story;
}

}   // namespace lore::test
