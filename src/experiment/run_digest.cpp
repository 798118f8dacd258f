#include "run_digest.h"

#include <lore/core/checksum.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace lore {

namespace {

std::string digested(std::string_view settings, WorkOrder const& order, std::uint64_t seed) {
    std::string const world = order.world_checksum == 0 ? order.arena_text : checksum_text(order.world_checksum);
    return fmt::format("{}\n{}\n{}\n{}", settings, world, order.knowledge_checksum, seed);
}

/// What the former digest put in the place of settings that do not affect results.
std::string_view former_neutral_value(std::string_view section, std::string_view key) {
    if (section.empty() && (key == "name" || key == "arena")) return "\"\"";
    if (section == "evolution" && key == "generations") return "0";
    if (section == "checkpoint" && key == "generations") return "100";
    if (section == "checkpoint" && key == "minutes") return "5";
    return "";
}

}   // namespace

std::uint64_t digest_of(WorkOrder const& order, std::uint64_t seed, std::string_view founders_checksum) {
    std::string text = digested(result_settings(order.config), order, seed);
    if (!founders_checksum.empty()) text += fmt::format("\n{}", founders_checksum);
    return checksum(text);
}

std::uint64_t former_digest_of(std::string_view config_text, WorkOrder const& order, std::uint64_t seed) {
    std::string text;
    std::string_view section;
    while (!config_text.empty()) {
        std::string_view const line = config_text.substr(0, config_text.find('\n'));
        config_text.remove_prefix(std::min(line.size() + 1, config_text.size()));
        std::size_t const equals = line.find(" = "), comment = line.rfind(" # ");
        if (line.starts_with('[')) section = line.substr(1, line.find(']') - 1);
        std::string_view const key = equals == std::string_view::npos ? "" : line.substr(0, equals);
        std::string_view const neutral = former_neutral_value(section, key);
        if (neutral.empty() || comment == std::string_view::npos) text += line;
        else text += fmt::format("{:<40}{}", fmt::format("{} = {}", key, neutral), line.substr(comment));
        text += '\n';
    }
    return checksum(digested(text, order, seed));
}

}   // namespace lore
