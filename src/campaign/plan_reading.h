#pragma once

#include <lore/core/toml.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// What the readers of a campaign's tables share.

using NameList = std::vector<std::string>;

inline constexpr std::int64_t most_runs = 9999;
inline constexpr std::int64_t most_generations = 10'000'000;
inline constexpr std::int64_t most_seed = std::numeric_limits<std::int64_t>::max() / 2;

/// In their order.
template <class Named>
std::vector<std::string> names_of(std::vector<Named> const& all) {
    std::vector<std::string> names;
    for (Named const& one : all) names.push_back(one.name);
    return names;
}

/// The value of `name`, which goes into paths. Throws UsageError: absent, or not 1 to 40 letters, digits, '_' and '-'.
std::string read_name(TomlTable const&);

/// The one key of `choices` that the table has. Throws UsageError: none, or several.
std::string_view only_key(TomlTable const&, std::vector<std::string_view> const& choices);

/// Throws UsageError, with the nearest name, unless `wanted` (the value of `key`) is one of those defined so far.
void require_known(TomlTable const&, std::string_view key, std::string const& wanted,
                   std::vector<std::string> const& known);

/// Throws UsageError if `name` is one of those defined so far.
void require_new(TomlTable const&, std::string const& name, std::vector<std::string> const& known);

}   // namespace lore
