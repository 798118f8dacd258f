#include <lore/archive/founders_file.h>

#include "boost_types.h"

#include <lore/core/channels.h>

#include <algorithm>

#include <nlohmann/json.hpp>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_description = 1u << 20;
constexpr std::size_t least_bytes_a_genome = 16;   ///< two counts

/// What a controller is connected to: a list of names each.
Json interface_of_this_build() {
    auto const names = std::span{channel_names};
    Json binary = Json::array();
    for (int const channel : binary_channels) binary.push_back(names[static_cast<std::size_t>(channel)]);
    return {{"sensors", names.first(sensor_count)}, {"effectors", names.last(effector_count)}, {"binary", binary}};
}

/// Writing JSON recurses, so that a forged document must not be deep.
bool refuse_depth(int depth, Json::parse_event_t, Json&) {
    if (depth > 8) throw std::out_of_range("its description cannot be understood");
    return true;
}

void check_interface(Json const& theirs, std::string_view name) {
    Json const ours = interface_of_this_build();
    for (auto const& [part, channels] : ours.items())
        if (theirs.at(part) != channels)
            throw UsageError(fmt::format("{} does not fit the robot", name),
                             fmt::format("its controllers have the {} channels {}, this Lore has {}", part,
                                         theirs.at(part).dump(), channels.dump()),
                             "Make founders from a knowledge base of this interface.");
}

}   // namespace

void write_founders(std::string const& path, FoundersFile const& founders) {
    Json const description{
        {"kind", founders.kind}, {"interface", interface_of_this_build()}, {"origin", Json::parse(founders.origin)}};
    std::string const text = description.dump(2, ' ', false, Json::error_handler_t::replace);
    write_container(path, FileKind::founders, write_with_boost([&](OutArchive& archive) {
                        put_blob(archive, std::vector<char>(text.begin(), text.end()));
                        std::uint64_t const count = founders.genomes.size();
                        archive << count;
                        for (Genome const& genome : founders.genomes) archive << genome;
                    }));
}

FoundersFile read_founders(std::string const& path) {
    return unpack_founders(read_container(path, FileKind::founders), path);
}

FoundersFile unpack_founders(std::span<std::byte const> payload, std::string_view name) {
    FoundersFile founders;
    read_with_boost(payload, name, [&](InArchive& archive) {
        std::vector<char> text;
        get_blob(archive, text, longest_description);
        // Before the genomes: those of another interface would look invalid.
        try {
            Json const description = Json::parse(text, refuse_depth);
            description.at("kind").get_to(founders.kind);
            check_interface(description.at("interface"), name);
            founders.origin = description.at("origin").dump(2);
        } catch (Json::exception const&) { archive.fail("its description cannot be understood"); }
        founders.genomes.resize(get_count(archive, least_bytes_a_genome));
        for (Genome& genome : founders.genomes) archive >> genome;
        if (founders.genomes.empty()) archive.fail("it has no genomes");
    });
    return founders;
}

}   // namespace lore
