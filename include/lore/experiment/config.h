#pragma once

#include <lore/archive/container.h>
#include <lore/evolution/evolution.h>
#include <lore/knowledge/window.h>
#include <lore/world/open.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lore {

/// One run, completely: a treatment is a value, not a build.
struct ExperimentConfig {
    std::string name = "source";              ///< of the treatment, for people
    WorldRequest world;                       ///< [world]; of none: collectball, with the arena and the task below
    std::string arena = "collectball";        ///< built-in arena's name, or a path, relative to the configuration file;
                                              ///< in an override, to the working directory
    std::string task = "source";              ///< one of the arena's tasks
    int stop_when_still = 0;                  ///< of collectball (CollectballWorld) [steps]
    std::vector<std::string> founders_from;   ///< bases, founders files or directories of runs; none: random founders.
                                              ///< Relative paths start where those of `arena` do
    EpisodeConfig episode;
    EvolutionConfig evolution;
    KnowledgeConfig knowledge;          ///< what a --kb must fit
    double squared_threshold = 0;       ///< if not 0, knowledge.match_threshold is its square root
    int checkpoint_generations = 100;   ///< a checkpoint every so many generations
    double checkpoint_minutes = 5;      ///< and every so many minutes

    /// Another world than collectball by its arena.
    bool has_world() const { return !world.name.empty() || !world.process.empty(); }
};

/// Reads jobs/*.toml; `overrides` are "section.key=value". Unknown keys are errors that name the nearest valid one.
/// A string's quotes and a list's brackets may be left out in an override, as a shell would eat them anyway.
ExperimentConfig read_config(std::string const& path, std::vector<std::string> const& overrides = {});
/// A configuration file, read once, since it may be a pipe: what is recorded and what is run are the same bytes.
struct ConfigFile {
    std::string path;   ///< where it was read: the new place of one that has moved; empty: none was given
    std::string text;
};
/// Throws UsageError: missing, a directory, not readable, without an end.
ConfigFile read_config_file(std::string const& path);
/// Relative paths start where the file lies; in a pipe, in the working directory.
ExperimentConfig parse_config(ConfigFile const&, std::vector<std::string> const& overrides = {});
/// The same from text; `name` is what errors call it, and relative paths start at `directory`.
ExperimentConfig parse_config(std::string_view text, std::string const& name, std::string const& directory,
                              std::vector<std::string> const& overrides = {});
/// The complete effective configuration, commented with meaning and unit; read_config reads it back to the same.
std::string to_toml(ExperimentConfig const&);

/// What a change of a setting changes.
enum class Affects : std::uint8_t {
    results,   ///< what a generation computes: fixed from a run's start to its end
    length,    ///< only the number of generations: a resumed run may go further
    nothing    ///< of the results: names, places, checkpoints
};

/// A setting that has different values in two configurations.
struct SettingDifference {
    std::string key;           ///< "section.key"
    std::string left, right;   ///< its values as TOML
    Affects affects = Affects::results;
};
/// In the order of config.toml.
std::vector<SettingDifference> differing_settings(ExperimentConfig const& left, ExperimentConfig const& right);
/// Only those that affect results.
std::vector<SettingDifference> differing_result_settings(ExperimentConfig const& left, ExperimentConfig const& right);
/// "evolution.population = 16, not 18": the left value, and not the right one.
std::string text(std::vector<SettingDifference> const&);

/// The settings that affect results and are not at their default: a line "section.key = value" each, sorted.
/// Descriptions do not enter, nor does a setting that is added in a later version, at its default.
std::string result_settings(ExperimentConfig const&);

}   // namespace lore
