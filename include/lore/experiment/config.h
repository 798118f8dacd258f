#pragma once

#include <lore/archive/container.h>
#include <lore/evolution/evolution.h>
#include <lore/knowledge/window.h>

#include <string>
#include <vector>

namespace lore {

/// One run, completely: a treatment is a value, not a build.
struct ExperimentConfig {
    std::string name = "source";         ///< of the treatment, for people
    std::string arena = "collectball";   ///< built-in arena's name, or a path, relative to the configuration file;
                                         ///< in an override, to the working directory
    std::string task = "source";         ///< one of the arena's tasks
    EpisodeConfig episode;
    EvolutionConfig evolution;
    KnowledgeConfig knowledge;          ///< what a --kb must fit
    int checkpoint_generations = 100;   ///< a checkpoint every so many generations
    double checkpoint_minutes = 5;      ///< and every so many minutes
};

/// Reads jobs/*.toml; `overrides` are "section.key=value". Unknown keys are errors that name the nearest valid one.
/// A string's quotes and a list's brackets may be left out in an override, as a shell would eat them anyway.
ExperimentConfig read_config(std::string const& path, std::vector<std::string> const& overrides = {});
/// The same from text; `name` is what errors call it, and relative paths start at `directory`.
ExperimentConfig parse_config(std::string_view text, std::string const& name, std::string const& directory,
                              std::vector<std::string> const& overrides = {});
/// The complete effective configuration, commented with meaning and unit; read_config reads it back to the same.
std::string to_toml(ExperimentConfig const&);

/// Settings ("section.key") whose values differ.
std::vector<std::string> differing_settings(ExperimentConfig const&, ExperimentConfig const&);

}   // namespace lore
