#include <lore/archive/lineage_file.h>

#include "birth_table.h"

#include <lore/evolution/evolution.h>

namespace lore {

std::shared_ptr<Birth const> LineageArchive::find(IndividualId id) const {
    std::size_t const place = place_of(births, id);
    if (place == births.size())
        throw Error(fmt::format("no individual {}.{} in the lineage archive", id.generation, id.slot),
                    "it has no living descendants", "Take an ancestor of the last population.");
    return births[place];
}

namespace {

constexpr std::size_t longest_text = std::size_t{1} << 20;   ///< paths of 200 origins of founders

}   // namespace

void write_lineage(std::string const& path, Population const& population, WorldRecord const& world,
                   std::optional<FoundersOrigin> const& founders) {
    write_container(path, FileKind::lineage, write_with_boost([&](OutArchive& archive) {
                        put_world(archive, world);
                        put_births(archive, ancestors_of(population.members));
                        std::int32_t const generation = population.generation;
                        IndividualId const best = best_of_run(population).id();
                        std::uint64_t const count = population.members.size();
                        archive << generation << best << count;
                        for (Individual const& member : population.members) {
                            IndividualId const id = member.id();
                            archive << id;
                        }
                        if (!founders) return;
                        for (std::string const* text : {&founders->kind, &founders->path, &founders->checksum})
                            put_text(archive, *text);
                    }));
}

LineageArchive read_lineage(std::string const& path) {
    return unpack_lineage(read_container(path, FileKind::lineage), path);
}

LineageArchive unpack_lineage(Payload const& payload, std::string_view name) {
    LineageArchive lineage;
    read_with_boost(payload, name, [&](InArchive& archive) {
        lineage.world = get_world(archive);
        lineage.births = get_births(archive);
        std::int32_t generation = 0;
        archive >> generation >> lineage.best;
        lineage.generation = generation;
        lineage.last_population.resize(get_count(archive, sizeof(IndividualId)));
        for (IndividualId& id : lineage.last_population) {
            archive >> id;
            if (place_of(lineage.births, id) == lineage.births.size())
                archive.fail("a member of the last population is missing");
        }
        if (generation < 0 || place_of(lineage.births, lineage.best) == lineage.births.size())
            archive.fail("the best-of-run is missing");
        if (archive.left() == 0) return;
        lineage.founders.emplace();
        for (std::string* text : {&lineage.founders->kind, &lineage.founders->path, &lineage.founders->checksum})
            *text = get_text(archive, longest_text);
    });
    return lineage;
}

}   // namespace lore
