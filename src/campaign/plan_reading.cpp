#include "plan_reading.h"

#include <lore/core/error.h>

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

std::string read_name(TomlTable const& table) {
    std::string name = table.required_string("name");
    bool const fits = !name.empty() && name.size() <= 40 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-';
    });
    if (!fits) table.fail("name", "a name is 1 to 40 letters, digits, '_' or '-'");
    return name;
}

std::string_view only_key(TomlTable const& table, std::vector<std::string_view> const& choices) {
    std::string_view found;
    for (std::string_view const key : choices) {
        if (!table.has(key)) continue;
        if (!found.empty()) table.fail(key, fmt::format("it excludes '{}'", found), "Keep one of them.");
        found = key;
    }
    if (found.empty()) {
        table.reject_unknown();   // one of them misspelt, most likely
        table.fail("name", fmt::format("one of {} is missing", fmt::join(choices, ", ")), "Add one.");
    }
    return found;
}

void require_known(TomlTable const& table, std::string_view key, std::string const& wanted,
                   std::vector<std::string> const& known) {
    if (std::find(known.begin(), known.end(), wanted) != known.end()) return;
    std::vector<std::string_view> const words(known.begin(), known.end());
    std::string const meant = nearest_word(wanted, words.data(), words.size());
    table.fail(key, fmt::format("there is no '{}' before it", wanted),
               meant.empty() ? "Define it first." : fmt::format("Did you mean '{}'?", meant));
}

void require_new(TomlTable const& table, std::string const& name, std::vector<std::string> const& known) {
    if (std::find(known.begin(), known.end(), name) != known.end())
        table.fail("name", fmt::format("'{}' is defined twice", name), "Rename one.");
}

}   // namespace lore
