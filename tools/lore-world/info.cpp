#include "command.h"

#include <lore/core/checksum.h>
#include <lore/core/shortest_digits.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace lore::world {

namespace {

struct InfoOptions {
    WorldOptions world;
    bool json = false;
};

nlohmann::ordered_json channels_json(std::vector<ChannelInfo> const& channels) {
    auto json = nlohmann::ordered_json::array();
    for (ChannelInfo const& channel : channels) json.push_back({{"name", channel.name}, {"binary", channel.binary}});
    return json;
}

void print_json(OpenedWorld const& opened) {
    WorldFacts const& facts = opened.world->facts();
    WorldOrigin const& origin = opened.origin;
    nlohmann::ordered_json json{{"name", facts.name},
                                {"task", facts.task},
                                {"reward_unit", facts.reward_unit},
                                {"sensors", channels_json(facts.sensors)},
                                {"effectors", channels_json(facts.effectors)},
                                {"outcome_size", facts.outcome_size},
                                {"max_batch", facts.max_batch},
                                {"width", shortest_digits(facts.width)},
                                {"height", shortest_digits(facts.height)},
                                {"scene_bytes", opened.world->scene_svg().size()},
                                {"settings", origin.settings}};
    if (!origin.file.empty())
        json["library"] = {
            {"file", origin.file}, {"bytes", origin.bytes}, {"checksum", checksum_text(origin.checksum)}};
    if (!origin.command.empty())
        json["process"] = {
            {"command", origin.command}, {"bytes", origin.bytes}, {"checksum", checksum_text(origin.checksum)}};
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string listed(std::vector<ChannelInfo> const& channels) {
    std::vector<std::string> names;
    for (ChannelInfo const& channel : channels) names.push_back(channel.name + (channel.binary ? " (binary)" : ""));
    return fmt::format("{}: {}", channels.size(), fmt::join(names, ", "));
}

void print_text(OpenedWorld const& opened) {
    WorldFacts const& facts = opened.world->facts();
    WorldOrigin const& origin = opened.origin;
    fmt::print("world        {}\ntask         {}\nreward       {}\nsensors      {}\neffectors    {}\n", facts.name,
               facts.task, facts.reward_unit, listed(facts.sensors), listed(facts.effectors));
    fmt::print("outcome      {} numbers\nsize         {} x {} u\nmax batch    {}\nscene        {} bytes\n",
               facts.outcome_size, facts.width, facts.height, facts.max_batch, opened.world->scene_svg().size());
    for (std::size_t at = 0, end; at < origin.settings.size(); at = end + 1) {
        end = origin.settings.find('\n', at);
        fmt::print("{:12} {}\n", at == 0 ? "settings" : "", origin.settings.substr(at, end - at));
    }
    if (std::string const from = text(origin); from.empty()) fmt::print("library      none: it is built in\n");
    else
        fmt::print("{:12} {}, {} bytes, checksum {}\n", origin.command.empty() ? "library" : "process", from,
                   origin.bytes, checksum_text(origin.checksum));
}

}   // namespace

void add_info(CLI::App& app, Program& program) {
    auto const options = std::make_shared<InfoOptions>();
    CLI::App* const command = app.add_subcommand("info", "Show the facts of a world");
    add_world(command, options->world);
    command->add_flag("--json", options->json, "as JSON");
    command->callback([&program, options] {
        program.chosen = [options] {
            OpenedWorld const opened = open_world(request_for(options->world));
            if (options->json) print_json(opened);
            else print_text(opened);
        };
    });
}

}   // namespace lore::world
