#include <lore/archive/founders_file.h>

#include "boost_types.h"
#include "world_json.h"

#include <lore/core/whole_number.h>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_description = 1u << 20;
constexpr std::size_t least_bytes_a_genome = 16;   ///< two counts

/// The world that a file of version 1 describes by `interface` alone.
void set_world(InArchive& archive, Json const& interface, WorldRecord& world) {
    world.channels = world_record_of(interface).channels;
    archive.set_world(world);
}

}   // namespace

void write_founders(std::string const& path, FoundersFile const& founders) {
    Json const description{{"kind", founders.kind}, {"origin", Json::parse(founders.origin)}};
    std::string const text = description.dump(2, ' ', false, Json::error_handler_t::replace);
    write_container(path, FileKind::founders, write_with_boost([&](OutArchive& archive) {
                        put_world(archive, founders.world);
                        put_text(archive, text);
                        std::uint64_t const count = founders.genomes.size();
                        archive << count;
                        for (Genome const& genome : founders.genomes) archive << genome;
                    }));
}

FoundersFile read_founders(std::string const& path) {
    return unpack_founders(read_container(path, FileKind::founders), path);
}

FoundersFile unpack_founders(Payload const& payload, std::string_view name) {
    FoundersFile founders;
    read_with_boost(payload, name, [&](InArchive& archive) {
        founders.world = get_world(archive);
        std::string const text = get_text(archive, longest_description);
        try {
            Json const description = Json::parse(text, refuse_deep_nesting<Json>);
            description.at("kind").get_to(founders.kind);
            if (payload.version == 1) set_world(archive, description.at("interface"), founders.world);
            founders.origin = description.at("origin").dump(2);
        } catch (Json::exception const&) { archive.fail("its description cannot be understood"); }
        founders.genomes.resize(get_count(archive, least_bytes_a_genome));
        for (Genome& genome : founders.genomes) archive >> genome;
        if (founders.genomes.empty()) archive.fail("it has no genomes");
    });
    return founders;
}

}   // namespace lore
