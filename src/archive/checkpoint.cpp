#include <lore/archive/checkpoint.h>

#include "birth_table.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/file.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <filesystem>
#include <ranges>

namespace lore {

namespace {

constexpr std::size_t least_bytes_a_member = 48;

/// What measuring distances relies on, by the kind of value.
bool is_possible(Tile tile) { return tile.x < tiles_per_side && tile.y < tiles_per_side; }
bool is_possible(std::floating_point auto value) { return std::isfinite(value); }
bool is_possible(std::integral auto) { return true; }
/// Whole steps, in whose last word the bits above the last channel are 0.
bool have_bits_of(Descriptors const& descriptors, int channels) {
    std::vector<std::uint16_t> const& words = descriptors.channel_bits;
    auto const in_a_step = static_cast<std::size_t>(descriptors.words());
    if (words.size() % in_a_step != 0) return false;
    int const in_last_word = channels - 16 * (descriptors.words() - 1);
    for (std::size_t last = in_a_step - 1; last < words.size(); last += in_a_step)
        if (words[last] >> in_last_word != 0) return false;
    return true;
}
bool is_possible(std::ranges::range auto const& items) {
    return std::ranges::all_of(items, [](auto const& item) { return is_possible(item); });
}

/// Of `channels` channels.
bool is_possible(Descriptors const& descriptors, int channels) {
    bool possible = descriptors.channels() == channels && have_bits_of(descriptors, channels);
    for_each_field(descriptors, [&](auto const& field) { possible = possible && is_possible(field); });
    return possible;
}

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
    // Of runs shaped by rule share alone; others end here.
    bool const by_share = !population.members.empty() && population.members.front().shown != nullptr;
    if (by_share)
        for (Individual const& member : population.members) put_blob(archive, *member.shown);
}

/// The features that each member shows, where the checkpoint has them.
void get_shown(InArchive& archive, Population& population) {
    if (archive.left() == 0) return;
    for (Individual& member : population.members) {
        auto shown = std::make_shared<std::vector<std::uint32_t>>();
        get_blob(archive, *shown, SIZE_MAX);
        bool const increasing =
            std::adjacent_find(shown->begin(), shown->end(), std::greater_equal<>{}) == shown->end();
        if (!increasing) archive.fail("features shown are out of order");
        member.shown = std::move(shown);
    }
}

Population get_population(InArchive& archive, int channels) {
    Population population;
    auto const births = get_births(archive);
    std::int32_t generation = 0;
    std::uint8_t kind = 0;
    archive >> generation >> kind;
    if (generation < 0 || kind >= distance_kinds) archive.fail("a value is out of range");
    population.generation = generation;
    population.distance_kind = static_cast<DistanceKind>(kind);
    population.members.resize(get_count(archive, least_bytes_a_member));
    if (population.members.empty()) archive.fail("the population is empty");
    for (Individual& member : population.members) {
        std::uint32_t place = 0;
        std::int32_t objectives = 0;
        auto descriptors = std::make_shared<Descriptors>();
        archive >> place >> objectives >> member.diversity >> member.crowding >> *descriptors;
        archive.load_binary(member.objectives.value.data(), sizeof member.objectives.value);
        if (place >= births.size() || objectives < 0 || objectives > 3 || std::isnan(member.crowding) ||
            !std::isfinite(member.diversity))
            archive.fail("a value is out of range");
        for (double const value : member.objectives.value)
            if (!std::isfinite(value)) archive.fail("an objective is not finite");
        member.birth = births[place];
        member.descriptors = std::move(descriptors);
        // Distances compare number by number, and their sums decide which individuals survive.
        if (member.descriptors->outcome.size() != population.members.front().descriptors->outcome.size())
            archive.fail("members have outcomes of different lengths");
        if (!is_possible(*member.descriptors, channels)) archive.fail("a descriptor that no evaluation gives");
        member.objectives.count = objectives;
    }
    get_shown(archive, population);
    return population;
}

}   // namespace

Bytes pack_checkpoint(Checkpoint const& checkpoint) {
    return write_with_boost([&](OutArchive& archive) {
        put_world(archive, checkpoint.world);
        std::uint64_t const signature = checkpoint.state.signature.value();
        archive << checkpoint.seed << checkpoint.config_digest << checkpoint.evaluations << checkpoint.steps
                << checkpoint.seconds << checkpoint.progress_bytes << signature;
        AllIndividualsMark const& mark = checkpoint.all_individuals;
        archive << mark.bytes << mark.chain << mark.generations;
        put_blob(archive, mark.gathered);
        put_population(archive, checkpoint.state.population);
    });
}

Checkpoint unpack_checkpoint(Payload const& payload, std::string_view name) {
    Checkpoint checkpoint;
    read_with_boost(payload, name, [&](InArchive& archive) {
        checkpoint.world = get_world(archive);
        std::uint64_t signature = 0;
        archive >> checkpoint.seed >> checkpoint.config_digest >> checkpoint.evaluations >> checkpoint.steps >>
            checkpoint.seconds >> checkpoint.progress_bytes >> signature;
        AllIndividualsMark& mark = checkpoint.all_individuals;
        archive >> mark.bytes >> mark.chain >> mark.generations;
        get_blob(archive, mark.gathered, SIZE_MAX);
        checkpoint.state.signature = Signature{signature};
        checkpoint.state.population = get_population(archive, checkpoint.world.channels.count());
    });
    return checkpoint;
}

void write_checkpoint(std::string const& path, std::string const& older, Checkpoint const& checkpoint) {
    // No second name for the same file in between: damage to one of the two must never be damage to both.
    replace_file(path, older, seal(FileKind::checkpoint, pack_checkpoint(checkpoint), Packing::fast));
}

FoundCheckpoint read_checkpoint(std::string const& path, std::string const& older) {
    // A disk that fails is no damage to the file: that is thrown, and what is there stays.
    Bytes const newer = is_there(path) || !is_there(older) ? read_file(path) : Bytes{};
    try {
        return {unpack_checkpoint(unseal(newer, FileKind::checkpoint, path), path), ""};
    } catch (NewerFormat const&) {
        throw;   // no damage: going on from the older one would throw the newer Lore's work away
    } catch (Error const& newer_fails) {
        FoundCheckpoint found;
        try {
            found.checkpoint = unpack_checkpoint(read_container(older, FileKind::checkpoint), older);
        } catch (Error const&) { throw newer_fails; }
        std::error_code failed;
        bool const is_damaged = std::filesystem::exists(path, failed);
        // The whole one takes the damaged one's place, or the next checkpoint would keep the damaged one and drop it.
        std::filesystem::rename(older, path, failed);
        if (failed)
            throw Error(fmt::format("cannot go on from {}", older), failed.message(), "Make its directory writable.");
        found.warning =
            fmt::format("{} Going on from the one before.",
                        is_damaged ? std::string{newer_fails.what()}
                                   : fmt::format("there is no {}: the run was killed as it wrote one.", path));
        return found;
    }
}

}   // namespace lore
