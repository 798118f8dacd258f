#include "settings.h"

#include <lore/core/error.h>
#include <lore/core/toml.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <map>

namespace lore {

namespace {

/// Collects descriptions; one overload of `add` a type of value.
class Description {
public:
    std::vector<Setting> settings;

    void section(std::string name) { section_ = std::move(name); }

    void add(std::string key, int& value, int least, int most, std::string_view doc,
             Affects affects = Affects::results) {
        push(
            key, fmt::format("{}; {}", doc, range(least, most)), Setting::Kind::value, affects,
            [=, &value](TomlTable const& table) {
                if (auto const read = table.integer(key, least, most)) value = static_cast<int>(*read);
            },
            [&value] { return fmt::format("{}", value); });
    }
    template <class Real>
    requires std::is_floating_point_v<Real>
    void add(std::string key, Real& value, double least, double most, std::string_view doc,
             Affects affects = Affects::results) {
        push(
            key, fmt::format("{}; {}", doc, range(least, most)), Setting::Kind::value, affects,
            [=, &value](TomlTable const& table) {
                if (auto const read = table.number(key, least, most)) value = static_cast<Real>(*read);
            },
            [&value] { return fmt::format("{}", value); });
    }
    void add(std::string key, bool& value, std::string_view doc, Affects affects = Affects::results) {
        push(
            key, std::string{doc}, Setting::Kind::value, affects,
            [=, &value](TomlTable const& table) {
                if (auto const read = table.boolean(key)) value = *read;
            },
            [&value] { return value ? "true" : "false"; });
    }
    void add(std::string key, std::string& value, std::string_view doc, Affects affects = Affects::results) {
        push(
            key, std::string{doc}, Setting::Kind::text, affects,
            [=, &value](TomlTable const& table) {
                if (auto read = table.string(key)) value = *std::move(read);
            },
            [&value] { return toml_string(value); });
    }
    /// A choice, written as its name; `parse` throws UsageError for an unknown one.
    template <class Choice>
    void add(std::string key, Choice& value, Choice (*parse)(std::string_view), std::string_view doc,
             Affects affects = Affects::results) {
        push(
            key, std::string{doc}, Setting::Kind::text, affects,
            [=, &value](TomlTable const& table) {
                auto const read = table.string(key);
                if (!read) return;
                try {
                    value = parse(*read);
                } catch (UsageError const& error) { table.fail(key, error); }
            },
            [&value] { return toml_string(name(value)); });
    }
    template <class Choice>
    void add(std::string key, std::vector<Choice>& values, Choice (*parse)(std::string_view), std::string_view doc,
             Affects affects = Affects::results) {
        push(
            key, std::string{doc}, Setting::Kind::list, affects,
            [=, &values](TomlTable const& table) {
                auto const read = table.strings(key);
                if (!read) return;
                if (read->empty()) table.fail(key, "the list is empty", "Name at least one.");
                std::vector<Choice> parsed;
                for (std::string const& word : *read) {
                    try {
                        parsed.push_back(parse(word));
                    } catch (UsageError const& error) { table.fail(key, error); }
                }
                values = std::move(parsed);
            },
            [&values] {
                std::vector<std::string> words;
                for (Choice value : values) words.emplace_back(name(value));
                return toml_strings(words);
            });
    }

    void add(std::string key, std::vector<std::string>& words, std::string_view doc,
             Affects affects = Affects::results) {
        push(
            key, std::string{doc}, Setting::Kind::list, affects,
            [=, &words](TomlTable const& table) {
                if (auto read = table.strings(key)) words = *std::move(read);
            },
            [&words] { return toml_strings(words); });
    }
    /// A path or a list of them, and written so.
    void add_paths(std::string key, std::vector<std::string>& paths, std::string_view doc,
                   Affects affects = Affects::results) {
        push(
            key, std::string{doc}, Setting::Kind::paths, affects,
            [=, &paths](TomlTable const& table) {
                if (auto read = table.one_or_more(key)) paths = *std::move(read);
            },
            [&paths] { return paths.size() > 1 ? toml_strings(paths) : toml_string(paths.empty() ? "" : paths[0]); });
    }
    /// A table of any keys, kept as lines (TomlTable::lines). One that is read later adds to it, and wins.
    void add_settings(std::string key, std::string& lines, std::string_view doc, Affects affects = Affects::results) {
        push(
            key, std::string{doc}, Setting::Kind::value, affects,
            [=, &lines](TomlTable const& table) {
                if (auto const read = table.table(key)) lines = merged(lines, read->lines());
            },
            [&lines] { return inline_table(lines); });
    }

private:
    static std::vector<std::string> split(std::string_view lines) {
        std::vector<std::string> all;
        for (std::size_t end = 0; (end = lines.find('\n')) != std::string_view::npos; lines.remove_prefix(end + 1))
            all.emplace_back(lines.substr(0, end));
        return all;
    }
    /// A key that becomes a table, or was one, loses what it was.
    static std::string merged(std::string_view old_lines, std::string_view new_lines) {
        auto const key_of = [](std::string const& line) { return line.substr(0, line.find(" = ")); };
        std::map<std::string, std::string> by_key;
        for (std::string const& line : split(old_lines)) by_key[key_of(line)] = line;
        for (std::string const& line : split(new_lines)) {
            std::string const key = key_of(line);
            std::erase_if(by_key, [&](auto const& old) {
                return old.first.starts_with(key + ".") || key.starts_with(old.first + ".");
            });
            by_key[key] = line;
        }
        std::string all;
        for (auto const& [key, line] : by_key) all += line + "\n";
        return all;
    }
    static std::string inline_table(std::string_view lines) {
        std::vector<std::string> const all = split(lines);
        return all.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(all, ", "));
    }
    template <class Number>
    static std::string range(Number least, Number most) {
        return most == std::numeric_limits<Number>::max() ? fmt::format("at least {}", least)
                                                          : fmt::format("{} .. {}", least, most);
    }
    void push(std::string const& key, std::string doc, Setting::Kind kind, Affects affects,
              std::function<void(TomlTable const&)> read, std::function<std::string()> text) {
        settings.push_back({section_, key, std::move(doc), kind, affects, std::move(read), std::move(text)});
    }

    std::string section_;
};

constexpr int any = std::numeric_limits<int>::max();

}   // namespace

std::vector<Setting> settings_of(ExperimentConfig& config) {
    Description d;
    d.section("");
    d.add("name", config.name, "of the treatment, for people and reports", Affects::nothing);
    // A path says nothing about results; what lies there does, and is compared as a text.
    d.add("arena", config.arena, "a built-in arena's name, or a path relative to this file", Affects::nothing);
    d.add("task", config.task, "one of the arena's tasks");

    d.section("world");
    // As with the arena, what lies there counts, and the checksum of a library is compared.
    d.add("library", config.world.name,
          "a built-in world, or a shared library (docs/manual/worlds.md); empty: the arena above", Affects::nothing);
    d.add("process", config.world.process, "or a program that serves a world, with its arguments");
    d.add("patience", config.world.patience, 0.001, 86400.0, "with a process: the longest that an answer may take [s]",
          Affects::nothing);
    d.add("folder", config.world.folder, "where both are looked for, and a process starts; empty: that of this file",
          Affects::nothing);
    d.add_settings("settings", config.world.settings, "what the world is told");

    d.section("episode");
    d.add("steps", config.episode.steps, 1, 32767, "length of an evaluation [steps]");
    d.add("stop_when_still", config.stop_when_still, 0, any,
          "in an arena: stop after so many steps without movement, counted together [steps]; 0 never");

    EvolutionConfig& evolution = config.evolution;
    d.section("evolution");
    d.add("population", evolution.population, 2, 100000, "survivors of a generation, and children of one");
    d.add("founders", evolution.founders, 2, 200000, "random individuals of generation 0; not fewer than population");
    d.add("generations", evolution.generations, 0, any, "length of the run [generations]", Affects::length);
    d.add("ties", evolution.ties, tie_rule,
          "order among equals in sorts and cuts: random, older or younger first, or insertion, the predecessor's");
    d.add("fronts", evolution.fronts, fronts_rule,
          "of two objectives: dominance, or sweep, by which the predecessor puts equals into successive fronts");
    d.add("ends_among_equals", evolution.ends_among_equals,
          "crowding: two members of a front that is equal in an objective are its ends, as with the predecessor");
    d.add("prune", evolution.prune, "newborns lose the hidden neurons that reach no output, as with the predecessor");
    d.add("use_diversity", evolution.use_diversity, "objective: behavioral diversity");
    d.add("use_shaping", evolution.use_shaping, "objective: reward shaping; set by --kb");

    d.section("founders");
    // As with the arena, what lies there counts.
    d.add_paths(
        "from", config.founders_from,
        "knowledge bases to clone founders from, founders files, or runs whose last populations they come from, "
        "in equal shares; empty: all are random",
        Affects::nothing);
    d.add("share", evolution.founding.share, 0.0, 1.0, "of the founders that come from there; the others are random");
    d.add("mutate", evolution.founding.mutate, "one mutation each of those that come from there");

    d.section("diversity");
    d.add("period", evolution.distance_schedule.period, 1, any,
          "the behavioral distance is drawn anew every so many generations");
    d.add("distances", evolution.distance_schedule.distances, distance_kind, "drawn from: " + distance_names());

    MutationConfig& mutation = evolution.mutation;
    d.section("mutation");
    d.add("weight_probability", mutation.weight_probability, 0.0, 1.0, "per weight: polynomial mutation");
    d.add("bias_probability", mutation.bias_probability, 0.0, 1.0, "per bias: polynomial mutation");
    d.add("rewire_probability", mutation.rewire_probability, 0.0, 1.0,
          "per connection, at most one a mutation: an end is redrawn");
    d.add("add_edge_probability", mutation.add_edge_probability, 0.0, 1.0, "a connection is added");
    d.add("delete_edge_probability", mutation.delete_edge_probability, 0.0, 1.0, "a connection is removed");
    d.add("add_neuron_probability", mutation.add_neuron_probability, 0.0, 1.0, "a connection is split by a new neuron");
    d.add("delete_neuron_probability", mutation.delete_neuron_probability, 0.0, 1.0,
          "a hidden neuron is removed with its connections");
    d.add("eta", mutation.eta, 0, 1023, "distribution index of the polynomial mutation; a power of two less one");

    d.section("limits");
    d.add("max_hidden", evolution.limits.max_hidden, 0, most_hidden, "hidden neurons of a controller");
    d.add("max_edges", evolution.limits.max_edges, 1, most_edges,
          "connections of a controller; not fewer than from every sensor to every effector");

    d.section("knowledge");
    d.add("window_length", config.knowledge.window_length, 1, longest_window,
          "what a knowledge base must have been cut with [steps]");
    d.add("match_threshold", config.knowledge.match_threshold, 0.0, 1000.0,
          "a window nearer than this to a feature matches it [L2]");
    d.add("squared_threshold", config.squared_threshold, 0.0, 1e6,
          "if not 0, match_threshold becomes its square root: the threshold is one of the squared distance");

    d.section("shaping");
    d.add("rule", evolution.shaping.rule, shaping_rule,
          "what a --kb makes of the features shown: max, distinct, sum or share");
    d.add("use", evolution.shaping.use, shaping_use, "of the shaping value: objective, distance (takes turns) or ties");

    d.section("checkpoint");
    d.add("generations", config.checkpoint_generations, 1, any, "a checkpoint every so many generations",
          Affects::nothing);
    d.add("minutes", config.checkpoint_minutes, 0.0, 1e6, "and every so many minutes; 0 after every generation",
          Affects::nothing);
    return std::move(d.settings);
}

}   // namespace lore
