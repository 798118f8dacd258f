// Builds, asks and derives knowledge bases.
//
//   lore-kb build runs/s1 --out kb1.lorekb
//   lore-kb info kb1.lorekb
//
// The first simulates the lineage of the best individual of runs/s1 again and writes its behavioral features with
// their values; the second shows what came out. docs/formats.md has the columns of the CSV files.

#include "program.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/knowledge_export.h>
#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/core/progress.h>
#include <lore/evolution/lineage.h>
#include <lore/experiment/knowledge_building.h>
#include <lore/experiment/verification.h>
#include <lore/experiment/version.h>
#include <lore/knowledge/derive.h>
#include <lore/knowledge/shaping.h>
#include <lore/knowledge/summary.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include <unistd.h>

namespace {

using namespace lore;

struct Arguments {
    std::string command_line;
    bool quiet = false;
    std::string input;                 ///< RUN_DIR, KB or FILE
    std::vector<std::string> inputs;   ///< KB KB...
    std::string out, csv, npy, run, windows, individual = "best", index = "exact";
    std::vector<std::string> consensus;
    KnowledgeConfig config;
    bool window_length_given = false, threshold_given = false, individual_given = false;
    bool all = false, json = false;
    int every = 1;   ///< of all
    std::uint64_t seed = 0;
    std::optional<int> top, least_count;   ///< of reduce
    std::optional<double> least_value;
};

std::string made_by(Arguments const& arguments) {
    BuildInformation const build = build_information();
    return fmt::format("{} (Lore {}, commit {})", arguments.command_line, build.version, build.commit);
}

void say(Arguments const& arguments, std::string const& line) {
    if (!arguments.quiet) fmt::print("{}\n", line);
}

/// Before long work is done for a file that cannot be written.
void check_writable(std::string const& path) {
    std::filesystem::path const directory = std::filesystem::path{path}.parent_path();
    std::string const place = directory.empty() ? "." : directory.string();
    if (std::filesystem::is_directory(path))
        throw UsageError(fmt::format("cannot write {}", path), "it is a directory", "Name a file in it.");
    if (!directory.empty() && !std::filesystem::is_directory(directory))
        throw UsageError(fmt::format("cannot write {}", path),
                         fmt::format("there is no directory {}", directory.string()), "Make it first.");
    if (::access(place.c_str(), W_OK) != 0)
        throw Error(fmt::format("cannot write {}", path), fmt::format("{}: {}", place, std::strerror(errno)),
                    "Choose a place where you may write.");
}

void build(Arguments const& arguments) {
    if (arguments.all && arguments.individual_given)
        throw UsageError("cannot build", "--all takes everybody, --individual the lineage of one", "Leave one out.");
    check_writable(arguments.out);
    IndexKind const kind = index_kind(arguments.index);
    RunDirectory const run = open_run(arguments.input);
    KnowledgeConfig config = run.config.knowledge;
    if (arguments.window_length_given) config.window_length = arguments.config.window_length;
    if (arguments.threshold_given) config.match_threshold = arguments.config.match_threshold;

    if (config.window_length > run.config.episode.steps)
        throw UsageError(fmt::format("cannot build with windows of {} steps", config.window_length),
                         fmt::format("an evaluation of this run has {}", run.config.episode.steps),
                         "Give a shorter --window-length.");
    auto const individual = run.individual(arguments.individual);
    auto const total = static_cast<std::int64_t>(
        arguments.all ? (archived_individuals(run) - 1) / static_cast<std::uint64_t>(arguments.every) + 1
                      : lineage_of(*individual).size());
    Progress progress{"building", total, "individuals", arguments.all ? 20000 : 500, arguments.quiet};
    BuildingObserver const observe = [&](std::int64_t done, std::int64_t features) {
        progress.update(done, fmt::format("{} features", features));
    };
    Provenance provenance;
    provenance.made_by = made_by(arguments);
    KnowledgeBase const base = arguments.all
                                   ? knowledge_of_all(run, arguments.every, config, kind, provenance, observe)
                                   : knowledge_of_lineage(run, *individual, config, kind, provenance, observe);
    write_knowledge_base(arguments.out, base);
    say(arguments, fmt::format("wrote {}: {} features from {} windows of {} individuals", arguments.out, base.size(),
                               base.provenance().windows, base.provenance().individuals));
}

void info(Arguments const& arguments) {
    KnowledgeBase const base = read_knowledge_base(arguments.input);
    Provenance const& origin = base.provenance();
    ValueSummary const summary = summarize(base.values(), 10);
    if (arguments.json) {
        nlohmann::ordered_json json{{"features", base.size()},
                                    {"threshold", base.config().match_threshold},
                                    {"window_length", base.config().window_length},
                                    {"channels", channel_count}};
        if (base.size() > 0) {
            json["values"] = {{"min", summary.lowest}, {"max", summary.highest}, {"mean", summary.mean}};
            json["histogram"] = {{"edges", summary.edges}, {"counts", summary.counts}};
        }
        json["provenance"] = nlohmann::ordered_json::parse(provenance_json(origin));
        fmt::print("{}\n", json.dump(2));
        return;
    }
    fmt::print("features     {}\nwindow       {} steps x {} channels\nthreshold    {} (Euclidean distance)\n",
               base.size(), base.config().window_length, channel_count, base.config().match_threshold);
    if (base.size() > 0) {
        fmt::print("values       {:.4g} to {:.4g}, mean {:.4g}\n", summary.lowest, summary.highest, summary.mean);
        auto const most = *std::max_element(summary.counts.begin(), summary.counts.end());
        for (std::size_t bin = 0; bin < summary.counts.size(); ++bin)
            fmt::print("  {:7.3f} ..{:7.3f} {:8} {}\n", summary.edges[bin], summary.edges[bin + 1], summary.counts[bin],
                       std::string(static_cast<std::size_t>(std::llround(
                                       40.0 * static_cast<double>(summary.counts[bin]) / static_cast<double>(most))),
                                   '#'));
    }
    fmt::print("kind         {}\nindex        {}\ntask         {}\nindividuals  {}\nwindows      {}\nbest balls   "
               "{}\nsources      {}\n",
               origin.kind, origin.index, origin.task, origin.individuals, origin.windows, origin.best_balls,
               fmt::join(origin.sources, ", "));
    for (std::string const& step : origin.derivation) fmt::print("then         {}\n", step);
    fmt::print("made by      {}\n", origin.made_by);
}

/// The trace of an archived individual, by simulating it again.
Trace trace_of(RunDirectory const& run, std::string const& which) {
    return record_episode(run.arena, compile(run.individual(which)->genome), run.config.episode);
}

void query(Arguments const& arguments) {
    if (arguments.run.empty() == arguments.windows.empty())
        throw UsageError("cannot query", "one source of windows is needed",
                         "Give either --run DIR or --windows FILE.npy.");
    if (arguments.individual_given && arguments.run.empty())
        throw UsageError("cannot query", "--individual is of a run", "Give --run DIR, or leave it out.");
    check_writable(arguments.csv);
    KnowledgeBase const base = read_knowledge_base(arguments.input);
    int const length = base.config().window_length;
    Trace const trace = arguments.run.empty() ? read_windows(arguments.windows, length)
                                              : trace_of(open_run(arguments.run), arguments.individual);
    Shaper const shaper{base, index_kind(arguments.index)};
    auto reader = shaper.reader();
    std::string csv = "window,step,feature,distance,value,count\n";
    int row = 0, found = 0;
    for (Window const& window : windows_of(trace, length)) {
        Match const match = reader.match(window);
        found += match.found();
        if (match.found())
            fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{}\n", row, row * length, match.feature,
                           std::sqrt(match.squared_distance), base.value(match.feature), base.count(match.feature));
        else fmt::format_to(std::back_inserter(csv), "{},{},-1,inf,-1,0\n", row, row * length);
        ++row;
    }
    write_file_atomically(arguments.csv, csv);
    say(arguments, fmt::format("wrote {}: {} of {} windows are in the knowledge base", arguments.csv, found, row));
}

void product(Arguments const& arguments) {
    check_writable(arguments.csv);
    RunDirectory const run = open_run(arguments.run);
    Trace const trace = trace_of(run, arguments.individual);
    std::vector<Shaper> shapers;
    std::string csv = "window,step,product";
    for (std::string const& path : arguments.inputs) {
        shapers.emplace_back(read_knowledge_base(path));
        int const length = shapers.front().base().config().window_length;
        if (shapers.back().base().config().window_length != length)
            throw UsageError(
                fmt::format("cannot combine {} with {}", path, arguments.inputs.front()),
                fmt::format("windows of {} and of {} steps", shapers.back().base().config().window_length, length),
                "Give knowledge bases of one window length.");
        fmt::format_to(std::back_inserter(csv), ",value_{}", shapers.size());
    }
    csv += '\n';
    int const length = shapers.front().base().config().window_length;
    int row = 0, salient = 0;
    for (Window const& window : windows_of(trace, length)) {
        std::vector<double> values;
        double all = 1;
        for (Shaper const& shaper : shapers) {
            Match const match = shaper.match(window);
            values.push_back(match.found() ? shaper.base().value(match.feature) : no_feature_value);
            all *= match.found() ? values.back() : 0;
        }
        salient += all != 0;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", row, row * length, all, fmt::join(values, ","));
        ++row;
    }
    write_file_atomically(arguments.csv, csv);
    say(arguments, fmt::format("wrote {}: {} of {} windows have a product other than 0", arguments.csv, salient, row));
}

/// Writes a derived knowledge base, which names the file it was made from.
void write_derived(Arguments const& arguments, KnowledgeBase const& derived, std::vector<std::string> sources) {
    KnowledgeBase::Parts parts = derived.parts();
    parts.provenance.made_by = made_by(arguments);
    parts.provenance.derivation.insert(parts.provenance.derivation.end() - 1,
                                       fmt::format("read from {}", fmt::join(sources, ", ")));
    write_knowledge_base(arguments.out, KnowledgeBase{std::move(parts)});
    say(arguments, fmt::format("wrote {}: {} features", arguments.out, derived.size()));
}

void randomize(Arguments const& arguments) {
    check_writable(arguments.out);
    write_derived(arguments, randomize(read_knowledge_base(arguments.input), arguments.seed), {arguments.input});
}

void reduce(Arguments const& arguments) {
    int const rules = arguments.top.has_value() + arguments.least_value.has_value() +
                      arguments.least_count.has_value() + !arguments.consensus.empty();
    if (rules != 1)
        throw UsageError("cannot reduce", "one rule is needed",
                         "Give one of --top, --min-value, --min-count and --consensus.");
    check_writable(arguments.out);
    KnowledgeBase const base = read_knowledge_base(arguments.input);
    if (arguments.top) return write_derived(arguments, keep_top(base, *arguments.top), {arguments.input});
    if (arguments.least_value)
        return write_derived(arguments, keep_valued(base, *arguments.least_value), {arguments.input});
    if (arguments.least_count)
        return write_derived(arguments, keep_shown(base, *arguments.least_count), {arguments.input});
    std::vector<KnowledgeBase> others;
    std::vector<std::string> sources{arguments.input};
    for (std::string const& path : arguments.consensus) {
        others.push_back(read_knowledge_base(path));
        sources.push_back(path);
    }
    write_derived(arguments, keep_consensus(base, others), sources);
}

void export_base(Arguments const& arguments) {
    if (arguments.npy.empty() == arguments.csv.empty())
        throw UsageError("cannot export", "one format is needed", "Give either --npy DIR or --csv FILE.");
    KnowledgeBase const base = read_knowledge_base(arguments.input);
    if (!arguments.npy.empty()) export_knowledge(arguments.npy, base);
    else {
        check_writable(arguments.csv);
        write_file_atomically(arguments.csv, knowledge_csv(base));
    }
    say(arguments,
        fmt::format("wrote {}: {} features", arguments.npy.empty() ? arguments.csv : arguments.npy, base.size()));
}

/// CLI11 reads "nan" as a number within any range.
CLI::Validator const a_number{[](std::string& text) {
                                  return std::isnan(std::strtod(text.c_str(), nullptr))
                                             ? fmt::format("'{}' is no number", text)
                                             : std::string{};
                              },
                              ""};

int run(int argc, char** argv) {
    Arguments arguments;
    arguments.command_line = fmt::format("lore-kb {}", fmt::join(argv + 1, argv + argc, " "));
    CLI::App app{
        "Builds, asks and derives knowledge bases: behavioral features and the rewards of those who showed them.",
        "lore-kb"};
    app.footer(
        "Examples:\n"
        "  lore-kb build runs/s1 --out kb1.lorekb                        from the lineage of the best-of-run\n"
        "  lore-kb build runs/s1 --all --out kb1all.lorekb               from every individual ever evaluated\n"
        "  lore-kb info kb1.lorekb --json\n"
        "  lore-kb query kb1.lorekb --run runs/t1 --csv found.csv        what the best of another run shows of it\n"
        "  lore-kb product kb1.lorekb kb2.lorekb --run runs/s1 --csv product.csv\n"
        "  lore-kb randomize kb1.lorekb --seed 1 --out kb1random.lorekb\n"
        "  lore-kb reduce kb1.lorekb --top 1000 --out top.lorekb\n"
        "  lore-kb export kb1.lorekb --npy kb1\n"
        "  lore-kb verify runs/s1/lineage.lore\n"
        "'lore-kb COMMAND --help' has the options of a command.\n"
        "Exit codes: 0 done, 2 usage or configuration, 1 any other failure.");
    app.set_version_flag("--version", [] { return version_text("lore-kb"); });
    app.require_subcommand(1);
    app.fallthrough();
    app.add_flag("-q,--quiet", arguments.quiet, "say nothing but errors");

    void (*chosen)(Arguments const&) = nullptr;
    auto const command = [&](char const* name, char const* what, void (*function)(Arguments const&)) {
        CLI::App* const added = app.add_subcommand(name, what);
        added->callback([&chosen, function] { chosen = function; });
        return added;
    };
    auto const add_base = [&](CLI::App* to) { to->add_option("KB", arguments.input, "knowledge base")->required(); };
    auto const add_out = [&](CLI::App* to) {
        to->add_option("--out", arguments.out, "knowledge base to write")->required();
    };
    auto const add_index = [&](CLI::App* to) {
        to->add_option("--index", arguments.index, "exact, or flann: approximate, and not repeatable from run to run")
            ->capture_default_str();
    };
    auto const add_individual = [&](CLI::App* to) {
        to->add_option("--individual", "'best', or GENERATION.SLOT")
            ->type_name("ID")
            ->default_str("best")
            ->each([&](std::string const& id) {
                arguments.individual = id;
                arguments.individual_given = true;
            });
    };

    CLI::App* const building = command("build", "Build a knowledge base from a run", build);
    building->add_option("RUN_DIR", arguments.input, "directory of a run")->required();
    add_out(building);
    add_individual(building);
    add_index(building);
    auto* const all = building->add_flag(
        "--all", arguments.all, "from every individual ever evaluated, in order of birth (needs '--archive all')");
    building->add_option("--every", arguments.every, "of all, only the first and every N-th after it")
        ->check(CLI::Range(1, 1000000000))
        ->needs(all);
    auto* const length_option =
        building->add_option("--window-length", arguments.config.window_length, "steps a window; default: the run's")
            ->check(CLI::Range(1, longest_window));
    auto* const threshold_option = building
                                       ->add_option("--threshold", arguments.config.match_threshold,
                                                    "distance below which a window matches; default: the run's")
                                       ->check(CLI::Range(1e-3, 1e3))
                                       ->check(a_number);

    CLI::App* const telling = command("info", "Show what is in a knowledge base and where it came from", info);
    add_base(telling);
    telling->add_flag("--json", arguments.json, "as JSON");

    CLI::App* const asking = command("query", "Look windows up", query);
    add_base(asking);
    asking->add_option("--run", arguments.run, "windows of an individual of this run");
    add_individual(asking);
    asking->add_option("--windows", arguments.windows, "windows from an NPY file, shape (n, T, 15) or (n, 15 T)");
    add_index(asking);
    asking->add_option("--csv", arguments.csv, "file to write: window,step,feature,distance,value,count")->required();

    CLI::App* const multiplying =
        command("product", "Multiply the values of several knowledge bases along an evaluation", product);
    multiplying->add_option("KB", arguments.inputs, "knowledge bases")->required()->expected(1, 1000);
    multiplying->add_option("--run", arguments.run, "run whose individual is evaluated")->required();
    add_individual(multiplying);
    multiplying->add_option("--csv", arguments.csv, "file to write: window,step,product,value_1,value_2,...")
        ->required();

    CLI::App* const randomizing = command("randomize", "Replace the values by random ones ('KB random')", randomize);
    add_base(randomizing);
    randomizing->add_option("--seed", arguments.seed, "of the random values")->required()->check(seed_digits);
    add_out(randomizing);

    CLI::App* const reducing = command("reduce", "Keep some of the features", reduce);
    add_base(reducing);
    reducing->add_option("--top", arguments.top, "this many of highest value")->check(CLI::Range(1, 1000000000));
    reducing->add_option("--min-value", arguments.least_value, "those of at least this value")->check(a_number);
    reducing->add_option("--min-count", arguments.least_count, "those that at least so many individuals have shown")
        ->check(CLI::Range(1, 1000000000));
    reducing->add_option("--consensus", arguments.consensus, "those that every one of these knowledge bases knows")
        ->expected(1, 1000);
    add_out(reducing);

    CLI::App* const exporting = command("export", "Write the features for other programs", export_base);
    add_base(exporting);
    exporting->add_option("--npy", arguments.npy,
                          "directory for features.npy, values.npy, reward_sums.npy, counts.npy, provenance.json");
    exporting->add_option("--csv", arguments.csv, "file, a row a feature");

    CLI::App* const verifying = command("verify", "Check any file that Lore writes", [](Arguments const& given) {
        say(given, fmt::format("{}: {}, whole", given.input, verify(given.input)));
    });
    verifying->add_option("FILE", arguments.input, "file, or directory of a run")->required();

    if (auto const only = parse_command_line(app, argc, argv)) return *only;
    arguments.window_length_given = length_option->count() > 0;
    arguments.threshold_given = threshold_option->count() > 0;
    chosen(arguments);
    return static_cast<int>(ExitCode::done);
}

}   // namespace

int main(int argc, char** argv) {
    return lore::run_program("lore-kb", [&] { return run(argc, argv); });
}
