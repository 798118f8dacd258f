#include <lore/archive/checkpoint.h>

#include "birth_table.h"

#include <cmath>
#include <filesystem>

namespace lore {

namespace {

constexpr std::size_t least_bytes_a_member = 48;

/// All but the distances among the members: evolution measures them anew, which costs less than keeping them here.
void put_population(OutArchive& archive, Population const& population) {
    auto const births = ancestors_of(population.members);
    put_births(archive, births);
    std::int32_t const generation = population.generation;
    auto const kind = static_cast<std::uint8_t>(population.distance_kind);
    std::uint64_t const count = population.members.size();
    archive << generation << kind << count;
    for (Individual const& member : population.members) {
        auto const place = static_cast<std::uint32_t>(place_of(births, member.id()));
        std::int32_t const objectives = member.objectives.count;
        archive << place << objectives << member.diversity << member.crowding << *member.descriptors;
        archive.save_binary(member.objectives.value.data(), sizeof member.objectives.value);
    }
}

Population get_population(InArchive& archive) {
    Population population;
    auto const births = get_births(archive);
    std::int32_t generation = 0;
    std::uint8_t kind = 0;
    archive >> generation >> kind;
    if (generation < 0 || kind >= distance_kinds) archive.fail("a value is out of range");
    population.generation = generation;
    population.distance_kind = static_cast<DistanceKind>(kind);
    population.members.resize(get_count(archive, least_bytes_a_member));
    for (Individual& member : population.members) {
        std::uint32_t place = 0;
        std::int32_t objectives = 0;
        auto descriptors = std::make_shared<Descriptors>();
        archive >> place >> objectives >> member.diversity >> member.crowding >> *descriptors;
        archive.load_binary(member.objectives.value.data(), sizeof member.objectives.value);
        if (place >= births.size() || objectives < 0 || objectives > 3 || std::isnan(member.crowding) || !std::isfinite(member.diversity)) archive.fail("a value is out of range");
        for (double const value : member.objectives.value)
            if (!std::isfinite(value)) archive.fail("an objective is not finite");
        member.birth = births[place];
        member.descriptors = std::move(descriptors);
        member.objectives.count = objectives;
    }
    return population;
}

} // namespace

Bytes pack_checkpoint(Checkpoint const& checkpoint) {
    return write_with_boost([&](OutArchive& archive) {
        std::uint64_t const signature = checkpoint.state.signature.value();
        archive << checkpoint.seed << checkpoint.config_digest << checkpoint.evaluations << checkpoint.steps << checkpoint.seconds
                << checkpoint.progress_bytes << signature;
        AllIndividualsMark const& mark = checkpoint.all_individuals;
        archive << mark.bytes << mark.chain << mark.generations;
        put_blob(archive, mark.gathered);
        put_population(archive, checkpoint.state.population);
    });
}

Checkpoint unpack_checkpoint(std::span<std::byte const> payload, std::string_view name) {
    Checkpoint checkpoint;
    read_with_boost(payload, name, [&](InArchive& archive) {
        std::uint64_t signature = 0;
        archive >> checkpoint.seed >> checkpoint.config_digest >> checkpoint.evaluations >> checkpoint.steps >> checkpoint.seconds
            >> checkpoint.progress_bytes >> signature;
        AllIndividualsMark& mark = checkpoint.all_individuals;
        archive >> mark.bytes >> mark.chain >> mark.generations;
        get_blob(archive, mark.gathered, SIZE_MAX);
        checkpoint.state.signature = Signature{signature};
        checkpoint.state.population = get_population(archive);
    });
    return checkpoint;
}

void write_checkpoint(std::string const& path, std::string const& older, Checkpoint const& checkpoint) {
    // Sealed before the former one is touched; a second name keeps it until the rename has replaced the first.
    Bytes const payload = pack_checkpoint(checkpoint);
    std::error_code failed;
    std::filesystem::remove(older, failed);
    std::filesystem::create_hard_link(path, older, failed);
    if (failed && std::filesystem::exists(path)) std::filesystem::copy_file(path, older, failed);   // no hard links here
    write_container(path, FileKind::checkpoint, payload, Packing::fast);
}

FoundCheckpoint read_checkpoint(std::string const& path, std::string const& older) {
    try {
        return {unpack_checkpoint(read_container(path, FileKind::checkpoint), path), ""};
    } catch (Error const& newer_fails) {
        try {
            return {unpack_checkpoint(read_container(older, FileKind::checkpoint), older),
                    fmt::format("{} Going on from {}, the one before.", newer_fails.what(), older)};
        } catch (Error const&) {
        }
        throw;
    }
}

} // namespace lore
