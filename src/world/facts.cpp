#include <lore/world/facts.h>

#include <lore/core/utf8.h>

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace lore {

namespace {

bool is_small_letter(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// As messages show it: a text of a library may hold anything.
std::string shown(std::string_view text) {
    std::string all;
    for (char const c : text.substr(0, longest_name)) all += c >= ' ' && c <= '~' ? c : '?';
    return text.size() > longest_name ? all + "..." : all;
}

std::string why_no_identifier(std::string_view kind, std::string_view name) {
    if (name.empty()) return fmt::format("{} has no name", kind);
    bool const good = is_small_letter(name[0]) && std::all_of(name.begin(), name.end(), [](char c) {
                          return is_small_letter(c) || is_digit(c) || c == '_';
                      });
    if (!good)
        return fmt::format("{} is called '{}', and not by a lower-case letter and then such letters, digits and '_'",
                           kind, shown(name));
    if (name.size() > longest_name)
        return fmt::format("the name '{}' of {} has {} bytes, and {} at most", shown(name), kind, name.size(),
                           longest_name);
    return "";
}

std::string why_outside(std::string_view what, long long count, int least, int most) {
    if (count >= least && count <= most) return "";
    return fmt::format("{} is {}, which is outside {} .. {}", what, count, least, most);
}

std::string why_no_size(std::string_view what, float size) {
    if (size > 0 && size <= largest_world) return "";   // false for NaN
    return fmt::format("its {} is {}, which is not above 0 and at most {}", what, size, largest_world);
}

std::string why_no_unit(std::string_view unit) {
    if (!unit.empty() && unit.size() <= longest_name && is_printable(unit)) return "";
    return fmt::format("its reward unit '{}' is not 1 to {} bytes of printable UTF-8", shown(unit), longest_name);
}

std::string why_channels_are_wrong(WorldFacts const& facts) {
    std::set<std::string_view> names;
    for (auto const* const channels : {&facts.sensors, &facts.effectors}) {
        char const* const kind = channels == &facts.sensors ? "sensor" : "effector";
        for (std::size_t c = 0; c < channels->size(); ++c) {
            std::string const& name = (*channels)[c].name;
            if (std::string why = why_no_identifier(fmt::format("{} {}", kind, c), name); !why.empty()) return why;
            if (!names.insert(name).second) return fmt::format("two channels are called '{}'", name);
        }
    }
    return "";
}

}   // namespace

std::string title(WorldFacts const& facts) { return fmt::format("world {} {}", facts.name, facts.task); }

std::string why_invalid(WorldFacts const& facts) {
    for (std::string why :
         {why_no_identifier("the world", facts.name), why_no_identifier("its task", facts.task),
          why_no_unit(facts.reward_unit),
          why_outside("its number of sensors", static_cast<long long>(facts.sensors.size()), 1, most_sensors),
          why_outside("its number of effectors", static_cast<long long>(facts.effectors.size()), 1, most_effectors),
          why_outside("its outcome_size", facts.outcome_size, 0, most_outcomes),
          why_outside("its max_batch", facts.max_batch, 1, most_lives), why_no_size("width", facts.width),
          why_no_size("height", facts.height), why_channels_are_wrong(facts)})
        if (!why.empty()) return why;
    return "";
}

}   // namespace lore
