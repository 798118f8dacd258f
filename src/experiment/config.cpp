#include <lore/experiment/config.h>

#include "settings.h"

#include <lore/core/error.h>
#include <lore/core/input_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

namespace lore {

namespace {

/// Takes every setting from the document; whatever it has besides is an error that names the nearest valid key.
void read_settings(TomlTable const& document, std::vector<Setting> const& settings) {
    std::map<std::string, TomlTable, std::less<>> sections;
    for (Setting const& setting : settings) {
        if (setting.section.empty()) {
            setting.read(document);
            continue;
        }
        auto section = sections.find(setting.section);
        if (section == sections.end()) {
            auto table = document.table(setting.section);
            if (!table) continue;
            section = sections.emplace(setting.section, *std::move(table)).first;
        }
        setting.read(section->second);
    }
    auto const reject = [&](TomlTable const& table, std::string_view section) {
        for (std::string const& key : table.keys()) {
            auto const belongs = [&](Setting const& s) {
                return s.section == section ? s.key == key : section.empty() && s.section == key;
            };
            if (std::any_of(settings.begin(), settings.end(), belongs)) continue;
            // A right key in the wrong section is a likelier mistake than a similar one in this section.
            auto const elsewhere =
                std::find_if(settings.begin(), settings.end(), [&](Setting const& s) { return s.key == key; });
            if (elsewhere != settings.end())
                table.fail(key, "unknown key", fmt::format("Did you mean '{}'?", elsewhere->full_key()));
        }
        table.reject_unknown();
    };
    reject(document, "");
    for (auto const& [section, table] : sections) reject(table, section);
}

/// Throws where the key of an override is the name of a section.
void refuse_section(std::string const& label, std::string const& key, std::vector<Setting> const& settings) {
    std::vector<std::string> keys;
    for (Setting const& setting : settings)
        if (!setting.section.empty() && setting.section == key) keys.push_back(setting.key);
    if (keys.empty()) return;
    throw UsageError(label, fmt::format("{} is a section; its keys are {}", key, fmt::join(keys, ", ")),
                     fmt::format("Write one of them, like --set {}.{}=...", key, keys.front()));
}

/// True of a value that TOML would want in quotes, and a shell not. What kind a world's settings are nobody knows.
bool is_word(std::string_view value) {
    auto const letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    auto const belongs = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
    return !value.empty() && letter(value.front()) && std::all_of(value.begin(), value.end(), belongs) &&
           value != "true" && value != "false" && value != "inf" && value != "nan";
}

/// "[section]\nkey = value" from "section.key=value".
TomlTable document_of(std::string const& override, std::vector<Setting> const& settings) {
    std::string const label = "--set " + override;
    std::size_t const equals = override.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError(label, "there is no key=value in it", "Write it like --set evolution.generations=500.");
    std::string key = override.substr(0, equals);
    std::string value = override.substr(equals + 1);
    if (constexpr std::string_view table = "world.settings."; key.starts_with(table)) {
        value = fmt::format("{{ {} = {} }}", key.substr(table.size()), is_word(value) ? "'" + value + "'" : value);
        key = table.substr(0, table.size() - 1);
    }
    auto const setting =
        std::find_if(settings.begin(), settings.end(), [&](Setting const& s) { return s.full_key() == key; });
    if (setting == settings.end()) {
        refuse_section(label, key, settings);
        std::vector<std::string> known;
        for (Setting const& s : settings) known.push_back(s.full_key());
        auto const elsewhere =
            std::find_if(settings.begin(), settings.end(), [&](Setting const& s) { return s.key == key; });
        std::vector<std::string_view> const views(known.begin(), known.end());
        std::string const meant =
            elsewhere != settings.end() ? elsewhere->full_key() : nearest_word(key, views.data(), views.size());
        throw UsageError(label, "unknown key",
                         meant.empty() ? "config.toml in the directory of any run has all of them."
                                       : fmt::format("Did you mean '{}'?", meant));
    }
    if (value.find_first_of("\r\n") != std::string::npos)
        throw UsageError(label, "the value has several lines", "Give one value.");
    bool const is_text =
        setting->kind == Setting::Kind::text || (setting->kind == Setting::Kind::paths && !value.starts_with('['));
    if (is_text && !value.starts_with('"') && !value.starts_with('\'')) value = toml_string(value);
    if (setting->kind == Setting::Kind::list && !value.starts_with('[')) {
        std::vector<std::string> words;
        std::istringstream list{value};
        for (std::string word; std::getline(list, word, ',');) words.push_back(word);
        value = toml_strings(words);
    }
    std::string const section = setting->section.empty() ? "" : fmt::format("[{}]\n", setting->section);
    return TomlTable::parse(fmt::format("{}{} = {}\n", section, setting->key, value), label, TomlTable::Lines::unknown);
}

/// What no single setting can judge. `name` is the file's, or what else the configuration came from.
void check(ExperimentConfig const& config, std::string const& name) {
    auto const refuse = [&](std::string_view key, std::string const& reason, std::string_view remedy) {
        throw UsageError(fmt::format("{}: {}", name, key), reason, remedy);
    };
    EvolutionConfig const& evolution = config.evolution;
    if (evolution.founders < evolution.population)
        refuse("evolution.founders",
               fmt::format("{} is less than the population of {}", evolution.founders, evolution.population),
               "Take at least as many.");
    if (evolution.ties == TieRule::insertion && evolution.shaping.use == ShapingUse::ties)
        refuse("evolution.ties", "insertion leaves equals where they stand, and shaping.use = ties orders them",
               "Take one of the two.");
    int const root = evolution.mutation.eta + 1;
    if ((root & (root - 1)) != 0)
        refuse("mutation.eta", fmt::format("{} + 1 is not a power of two", evolution.mutation.eta),
               "Take 15, as the paper does, or 7 or 31.");
    WorldRequest const& world = config.world;
    if (!world.process.empty() && !world.name.empty())
        refuse("world.process", "the world is a library already", "Name one of both.");
    if (!world.process.empty() && world.process[0].empty())
        refuse("world.process", "it names no program", "Write [\"python3\", \"mine.py\"], for example.");
    if (!config.has_world() && !world.settings.empty())
        refuse("world.settings", "no world is named that they could be told", "Name a 'library' or a 'process'.");
    if (!config.has_world() && !world.folder.empty())
        refuse("world.folder", "no world is named that it could be of", "Name a 'library' or a 'process'.");
    if (world.process.empty() && world.patience != WorldRequest{}.patience)
        refuse("world.patience", "only a process has a time limit", "Remove it, or name a 'process'.");
    if (config.knowledge.window_length > config.episode.steps)
        refuse("knowledge.window_length",
               fmt::format("{} is more than the {} steps of an evaluation", config.knowledge.window_length,
                           config.episode.steps),
               "Take at most episode.steps.");
    if (!(config.knowledge.match_threshold > 0))
        refuse("knowledge.match_threshold", "0 matches nothing", "Take a positive number.");
}

/// A path of an arena file starts where the configuration lies; a built-in arena's name is left alone.
std::string located(std::string const& arena, std::string const& directory) {
    bool const is_path = arena.find('/') != std::string::npos || arena.ends_with(".toml");
    if (!is_path || std::filesystem::path{arena}.is_absolute()) return arena;
    return current_path((std::filesystem::path{directory} / arena).lexically_normal().string());
}

}   // namespace

ExperimentConfig parse_config(std::string_view text, std::string const& name, std::string const& directory,
                              std::vector<std::string> const& overrides) {
    ExperimentConfig config;
    auto const settings = settings_of(config);
    TomlTable const document = TomlTable::parse(text, name);
    if (document.has("treatment") || document.has("transfer"))
        throw UsageError(name, "it is a campaign, not the configuration of a run",
                         "Run it with 'lore-campaign run', or name a configuration, such as jobs/tasks/source.toml.");
    read_settings(document, settings);
    config.arena = located(config.arena, directory);
    if (config.has_world())
        config.world.folder =
            config.world.folder.empty()
                ? directory
                : (std::filesystem::path{directory} / config.world.folder).lexically_normal().string();
    for (std::string& from : config.founders_from)
        from = (std::filesystem::path{directory} / from).lexically_normal().string();
    std::string origin = name;
    for (std::string const& override : overrides) {
        read_settings(document_of(override, settings), settings);
        origin = fmt::format("{} with --set {}", name, override);
    }
    if (config.squared_threshold > 0)
        config.knowledge.match_threshold = static_cast<float>(std::sqrt(config.squared_threshold));
    check(config, origin);
    return config;
}

ConfigFile read_config_file(std::string const& path) {
    std::string const current = current_path(path);
    return {current, read_text(current)};
}

ExperimentConfig parse_config(ConfigFile const& file, std::vector<std::string> const& overrides) {
    std::filesystem::path const path{file.path};
    bool const has_a_place = std::filesystem::is_regular_file(path);
    return parse_config(file.text, file.path, has_a_place ? path.parent_path().string() : "", overrides);
}

ExperimentConfig read_config(std::string const& path, std::vector<std::string> const& overrides) {
    return parse_config(read_config_file(path), overrides);
}

std::string to_toml(ExperimentConfig const& config) {
    ExperimentConfig copy = config, unchanged;   // settings are bound for reading as well
    auto const settings = settings_of(copy), usual = settings_of(unchanged);
    std::string text = "# The complete configuration of a run of Lore.\n";
    std::string section;
    for (std::size_t i = 0; i < settings.size(); ++i) {
        Setting const& setting = settings[i];
        // Where there is a world, the usual arena and its task would pass for those of the run.
        bool const of_arena = setting.full_key() == "arena" || setting.full_key() == "task";
        if (of_arena && config.has_world() && setting.text() == usual[i].text()) continue;
        if (setting.section != section) {
            section = setting.section;
            text += fmt::format("\n[{}]\n", section);
        }
        text += fmt::format("{:<40} # {}\n", fmt::format("{} = {}", setting.key, setting.text()), setting.doc);
    }
    return text;
}

std::vector<SettingDifference> differing_settings(ExperimentConfig const& left, ExperimentConfig const& right) {
    ExperimentConfig a = left, b = right;
    auto const of_a = settings_of(a), of_b = settings_of(b);
    std::vector<SettingDifference> differences;
    for (std::size_t i = 0; i < of_a.size(); ++i)
        if (std::string ours = of_a[i].text(), theirs = of_b[i].text(); ours != theirs)
            differences.push_back({of_a[i].full_key(), std::move(ours), std::move(theirs), of_a[i].affects});
    return differences;
}

std::vector<SettingDifference> differing_result_settings(ExperimentConfig const& left, ExperimentConfig const& right) {
    auto differences = differing_settings(left, right);
    std::erase_if(differences, [](SettingDifference const& one) { return one.affects != Affects::results; });
    return differences;
}

std::string text(std::vector<SettingDifference> const& differences) {
    std::vector<std::string> texts;
    for (SettingDifference const& one : differences)
        texts.push_back(fmt::format("{} = {}, not {}", one.key, one.left, one.right));
    return fmt::format("{}", fmt::join(texts, "; "));
}

std::string result_settings(ExperimentConfig const& config) {
    std::vector<std::string> lines;
    for (SettingDifference const& one : differing_result_settings(config, {}))
        lines.push_back(fmt::format("{} = {}\n", one.key, one.left));
    std::sort(lines.begin(), lines.end());
    return fmt::format("{}", fmt::join(lines, ""));
}

}   // namespace lore
