#pragma once

#include <lore/core/toml.h>
#include <lore/experiment/config.h>

#include <functional>
#include <string>
#include <vector>

namespace lore {

/// One setting of an ExperimentConfig, described once: reading, --set, config.toml, its comments, and what a resumed
/// run may change all follow from it.
///
/// A default never changes: checkpoints are guarded by the settings that are not at their default (run_digest.h). What
/// shall be different from now on is a new setting, or a value in jobs/.
struct Setting {
    /// All but `value` may come unquoted from a command line.
    enum class Kind : std::uint8_t { value, text, list, paths };

    std::string section;   ///< "" for the keys of the run itself
    std::string key;
    std::string doc;   ///< meaning, unit in brackets, range
    Kind kind = Kind::value;
    Affects affects = Affects::results;
    std::function<void(TomlTable const&)> read;   ///< from the table of its section, if the key is there
    std::function<std::string()> text;            ///< the present value as TOML

    std::string full_key() const { return section.empty() ? key : section + "." + key; }
};

/// All settings in the order of config.toml, bound to `config`: valid as long as it, and only at its address.
std::vector<Setting> settings_of(ExperimentConfig& config);

}   // namespace lore
