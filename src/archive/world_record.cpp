#include <lore/archive/world_record.h>

#include "world_json.h"

#include <lore/core/checksum.h>
#include <lore/core/whole_number.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> names_of(std::span<ChannelInfo const> channels) {
    std::vector<std::string> names;
    for (ChannelInfo const& channel : channels) names.push_back(channel.name);
    return names;
}

std::vector<ChannelInfo> infos_of(Json const& names, std::vector<std::string> const& binary) {
    std::vector<ChannelInfo> infos;
    for (Json const& name : names) {
        infos.push_back({name.get<std::string>(), false});
        infos.back().binary = std::find(binary.begin(), binary.end(), infos.back().name) != binary.end();
    }
    return infos;
}

std::uint64_t checksum_of_text(std::string const& text) {
    std::uint64_t value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (text.size() != 16 || error != std::errc{} || end != text.data() + text.size())
        throw std::out_of_range("its world's checksum is no number");
    return value;
}

/// Of the world with what was not recorded filled in.
std::string why_invalid(WorldRecord const& record) {
    WorldFacts facts;
    auto const or_else = [](auto const& value, auto const& otherwise) -> auto const& {
        return value == std::decay_t<decltype(value)>{} ? otherwise : value;
    };
    std::string const any = "unknown";
    float const one = 1;
    facts.name = or_else(record.name, any);
    facts.task = or_else(record.task, any);
    facts.reward_unit = or_else(record.reward_unit, any);
    Channels const unknown{{{"sensor", false}}, {{"effector", false}}};
    Channels const& channels = or_else(record.channels, unknown);
    auto const effectors = channels.all().begin() + channels.sensors();
    facts.sensors.assign(channels.all().begin(), effectors);
    facts.effectors.assign(effectors, channels.all().end());
    facts.outcome_size = record.outcome_size;
    facts.width = or_else(record.width, one);
    facts.height = or_else(record.height, one);
    return lore::why_invalid(facts);
}

template <class T>
bool differ(T const& stored, T const& present) {
    return stored != T{} && present != T{} && stored != present;
}

}   // namespace

Json json_of(WorldRecord const& record) {
    auto const all = record.channels.all();
    auto const sensors = static_cast<std::size_t>(record.channels.sensors());
    Json binary = Json::array();
    for (int const channel : record.channels.binary()) binary.push_back(record.channels[channel].name);
    Json json = Json::object();
    auto const put = [&json](char const* key, auto const& value) {
        if (value != std::decay_t<decltype(value)>{}) json[key] = value;
    };
    put("name", record.name);
    put("task", record.task);
    put("reward_unit", record.reward_unit);
    json["sensors"] = names_of(all.first(sensors));
    json["effectors"] = names_of(all.subspan(sensors));
    json["binary"] = std::move(binary);
    put("outcome_size", record.outcome_size);
    put("width", record.width);
    put("height", record.height);
    put("file", record.file);
    if (record.checksum != 0) json["xxh3_64"] = checksum_text(record.checksum);
    put("settings", record.settings);
    return json;
}

WorldRecord world_record_of(Json const& json) {
    WorldRecord record;
    auto const get = [&json](char const* key, auto& value) {
        if (json.contains(key)) json.at(key).get_to(value);
    };
    get("name", record.name);
    get("task", record.task);
    get("reward_unit", record.reward_unit);
    auto const binary = json.at("binary").get<std::vector<std::string>>();
    record.channels = {infos_of(json.at("sensors"), binary), infos_of(json.at("effectors"), binary)};
    if (static_cast<std::size_t>(record.channels.binary_count()) != binary.size())
        throw std::out_of_range("its world names a binary channel that it does not have");
    if (json.contains("outcome_size")) record.outcome_size = whole_number<int>(json.at("outcome_size"));
    get("width", record.width);
    get("height", record.height);
    get("file", record.file);
    if (json.contains("xxh3_64")) record.checksum = checksum_of_text(json.at("xxh3_64").get<std::string>());
    get("settings", record.settings);
    if (std::string const why = why_invalid(record); !why.empty())
        throw std::out_of_range("its world is no world: " + why);
    return record;
}

WorldRecord world_record(WorldFacts const& facts, WorldOrigin const& origin) {
    return {
        facts.name,         facts.task,     facts.reward_unit, Channels{facts},
        facts.outcome_size, facts.width,    facts.height,      std::filesystem::path{origin.file}.filename().string(),
        origin.checksum,    origin.settings};
}

std::string to_json(WorldRecord const& record) {
    return json_of(record).dump(2, ' ', false, Json::error_handler_t::replace);
}

WorldRecord parse_world_record(std::string_view text) {
    try {
        return world_record_of(Json::parse(text));
    } catch (Json::exception const&) { throw std::out_of_range("its world cannot be understood"); }
}

std::string why_other(WorldRecord const& stored, WorldRecord const& present) {
    if (differ(stored.name, present.name)) return fmt::format("made in world {}, not in {}", stored.name, present.name);
    if (differ(stored.task, present.task))
        return fmt::format("made for task {} of world {}, not for {}", stored.task, present.name, present.task);
    if (differ(stored.channels, present.channels)) return why_misfit(stored.channels, present.channels);
    if (differ(stored.checksum, present.checksum))
        return fmt::format("made with another build of {} (checksum {}, now {})", present.file,
                           checksum_text(stored.checksum), checksum_text(present.checksum));
    bool const recorded = !stored.name.empty();   // otherwise empty settings say nothing
    if (recorded && stored.settings != present.settings)
        return fmt::format("made with other settings of world {}", present.name);
    if (differ(stored.reward_unit, present.reward_unit))
        return fmt::format("its rewards are {}, not {}", stored.reward_unit, present.reward_unit);
    if (differ(stored.outcome_size, present.outcome_size))
        return fmt::format("its outcomes have {} numbers, not {}", stored.outcome_size, present.outcome_size);
    if (differ(stored.width, present.width) || differ(stored.height, present.height))
        return fmt::format("made in a world of {} x {}, not {} x {}", stored.width, stored.height, present.width,
                           present.height);
    return "";
}

}   // namespace lore
