// Repeats an evaluation and shows it.
//
//   lore-replay runs/s1 --kb kb1.lorekb --out replay
//   lore-replay --follow trace.csv.gz --task source --out followed.csv
//
// The first writes replay/trace.csv, and trajectory.svg and .png colored by the knowledge base's values; the second
// takes a recorded trace and writes what Lore's simulation makes of each of its steps. docs/manual/formats.md has the
// columns.

#include "program.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/genome_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/archive/world_trace.h>
#include <lore/arena_view/record.h>
#include <lore/arena_view/trajectory.h>
#include <lore/collectball/replay.h>
#include <lore/collectball/trace_file.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/experiment/run_directory.h>
#include <lore/experiment/version.h>
#include <lore/figure/svg.h>
#include <lore/figure/trajectory.h>
#include <lore/knowledge/product.h>
#include <lore/world/reward_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

namespace {

using namespace lore;

struct Arguments {
    std::string run, individual = "best", actions, follow, task, arena = "collectball", out;
    std::vector<std::string> knowledge;
    bool quiet = false;
};

/// The values of a trajectory's windows: those of the one knowledge base, or the product of several (paper, figure 6).
struct WindowValues {
    std::vector<double> values;   ///< NaN: not found in some knowledge base
    double lowest = 0, highest = 1, not_found = -1;
    std::string label;
};

WindowValues values_of(Trace const& trace, int window_length, std::vector<Shaper> const& shapers,
                       std::string const& unit) {
    WindowValues found;
    found.label = fmt::format("value ({})", unit);
    std::vector<Window> const windows = windows_of(trace, window_length);
    std::vector<FoundValues> values;
    for (Shaper const& shaper : shapers) values.push_back(values_of(shaper, windows));
    found.values = product_of(values);
    for (FoundValues const& of_base : values)
        for (std::size_t i = 0; i < windows.size(); ++i)
            if (!of_base[i]) found.values[i] = std::numeric_limits<double>::quiet_NaN();
    if (shapers.size() == 1) {
        auto const values = shapers.front().base().values();
        auto const [least, most] = std::minmax_element(values.begin(), values.end());
        found.lowest = *least;
        found.highest = *most;
        found.not_found = shapers.front().nothing_shown();
    } else {
        found.not_found = 0;
        found.lowest = found.highest = 0;
        for (double const value : found.values) {
            if (value > found.highest) found.highest = value;
            if (value < found.lowest) found.lowest = value;
        }
        if (found.highest == found.lowest) found.highest = 1;
        found.label = fmt::format("product of {} values ({}^{})", shapers.size(), unit, shapers.size());
    }
    return found;
}

std::vector<Shaper> read_knowledge(std::vector<std::string> const& paths, Channels const& channels,
                                   KnowledgeConfig& config) {
    std::vector<KnowledgeBase> bases = read_knowledge_bases(paths);
    std::vector<Shaper> shapers;
    for (std::size_t k = 0; k < bases.size(); ++k) {
        if (bases[k].size() == 0)
            throw UsageError(fmt::format("cannot use {}", paths[k]), "the knowledge base is empty",
                             "Give another one.");
        require_channels(bases[k], paths[k], channels);
        if (k == 0) config = bases[k].config();
        shapers.emplace_back(std::move(bases[k]));
    }
    return shapers;
}

/// The picture but for the path itself.
TrajectoryPicture picture_of(Arguments const& arguments, RunDirectory const& run, IndividualId id, double reward,
                             std::string const& unit) {
    TrajectoryPicture picture;
    picture.title = fmt::format("{}, individual {}: {}", run.config.name, text(id), reward_text(reward, unit));
    if (arguments.knowledge.empty()) return picture;
    std::vector<std::string> names;
    for (std::string const& path : arguments.knowledge) names.push_back(std::filesystem::path(path).stem().string());
    picture.title += fmt::format(", colored by {}", fmt::join(names, " x "));
    return picture;
}

void color(TrajectoryPicture& picture, WindowValues values) {
    picture.values = std::move(values.values);
    picture.lowest = values.lowest;
    picture.highest = values.highest;
    picture.not_found = values.not_found;
    picture.value_label = values.label;
}

/// What a run's replay leaves.
struct Drawn {
    std::string csv, svg;
};

/// In an arena: with the robot and all that happens.
Drawn draw_in_arena(CollectballWorld const& world, Network const& network, EpisodeConfig const& config,
                    TrajectoryPicture const& picture) {
    std::vector<StepRecord> const steps = record_steps(world, network, config);
    std::vector<Pose> poses;
    std::vector<std::uint8_t> carrying;
    for (StepRecord const& step : steps) {
        poses.push_back(step.pose);
        carrying.push_back(step.sensors[static_cast<std::size_t>(Channel::carrying)] > 0.5f);
    }
    return {trace_csv(steps), draw_trajectory(scene_of(world.arena()), RobotPath{poses, carrying}, picture)};
}

constexpr char failed_individual[] = "failed";

/// An individual of the run, or the one whose evaluation failed, whose reward nobody knows.
std::shared_ptr<Birth const> individual_of(RunDirectory const& run, std::string const& which) {
    if (which != failed_individual) return run.individual(which);
    std::string const path = run.file(run_file::failed_genome);
    if (!std::filesystem::exists(path))
        throw UsageError(fmt::format("no evaluation of {} failed", run.path), fmt::format("there is no {}", path),
                         "Name another individual.");
    FailedIndividual const failed = read_genome(path);
    if (std::string const other = why_other(failed.world, run.world.record()); !other.empty())
        throw Error(fmt::format("cannot repeat {}", path), other, "Give the run the world that it was made with.");
    auto birth = std::make_shared<Birth>();
    birth->id = failed.id;
    birth->genome = failed.genome;
    return birth;
}

/// 1. Simulate the individual again. 2. Look its windows up. 3. Write the trace and draw it.
void replay_run(Arguments const& arguments) {
    bool const failed = arguments.individual == failed_individual;
    RunDirectory const run = failed ? open_unfinished_run(arguments.run) : open_run(arguments.run);
    auto const birth = individual_of(run, arguments.individual);
    World const& world = *run.world.world;
    std::string const& unit = world.facts().reward_unit;
    KnowledgeConfig config = run.config.knowledge;
    std::vector<Shaper> const shapers = read_knowledge(arguments.knowledge, Channels{world.facts()}, config);

    Network const network = compile(birth->genome);
    Trace const trace = record_episode(world, network, run.config.episode);
    if (!failed && trace.reward != birth->reward)
        throw Error(
            fmt::format("individual {} does not repeat", text(birth->id)),
            fmt::format("{} now, {} in its archive", reward_text(trace.reward, unit), reward_text(birth->reward, unit)),
            "Replay it with the version of Lore and the world that the run was made with.");

    TrajectoryPicture picture = picture_of(arguments, run, birth->id, trace.reward, unit);
    picture.window_length = config.window_length;
    if (!shapers.empty()) color(picture, values_of(trace, config.window_length, shapers, unit));
    picture.positions = trace.positions;
    auto const arena = arena_world(run.world.world);
    Drawn const drawn =
        arena ? draw_in_arena(*arena, network, run.config.episode, picture)
              : Drawn{trace_csv(world, network, run.config.episode), draw_trajectory(scene_of(world), picture)};

    make_directory(arguments.out);
    std::filesystem::path const out{arguments.out};
    write_file_atomically((out / "trace.csv").string(), drawn.csv);
    write_file_atomically((out / "trajectory.svg").string(), drawn.svg);
    write_file_atomically((out / "trajectory.png").string(), render_png(drawn.svg));
    if (arguments.quiet) return;
    auto const found =
        std::count_if(picture.values.begin(), picture.values.end(), [](double value) { return !std::isnan(value); });
    fmt::print("individual {}: {} in {} steps{}\n", text(birth->id), reward_text(trace.reward, unit), trace.steps(),
               shapers.empty() ? ""
                               : fmt::format(", {} of {} windows in the knowledge base{}", found, picture.values.size(),
                                             shapers.size() > 1 ? "s" : ""));
    fmt::print("wrote {0}/trace.csv, {0}/trajectory.svg, {0}/trajectory.png\n", arguments.out);
}

/// --actions and --follow: no run, no controller, only the arena.
void replay_file(Arguments const& arguments) {
    Arena const arena = load_arena(arguments.arena, arguments.task);
    bool const following = !arguments.follow.empty();
    std::vector<StepRecord> const steps = following ? follow(arena, read_trace_csv(arguments.follow, arena))
                                                    : drive(arena, read_actions_csv(arguments.actions));
    write_file_atomically(arguments.out, trace_csv(steps));
    if (!arguments.quiet)
        fmt::print("wrote {}: {} steps, {} collected\n", arguments.out, steps.size(),
                   reward_text(steps.back().collected, first_reward_unit));
}

int run(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{"Repeats an evaluation: of an individual of a run, of a list of actions, or of a recorded trace.",
                 "lore-replay"};
    app.footer(
        "Examples:\n"
        "  lore-replay runs/s1 --kb kb1.lorekb --out replay       best-of-run, colored by the values of kb1 (figure "
        "5)\n"
        "  lore-replay runs/s1 --kb kb1.lorekb --kb kb2.lorekb --out replay   by the product of both (figure 6)\n"
        "  lore-replay runs/s1 --individual 312.17 --out replay   another ancestor of the last population\n"
        "  lore-replay runs/s1 --individual failed --out replay   the one whose evaluation ended the run\n"
        "  lore-replay --actions a.csv --task source --out trace.csv          open loop: columns a0,a1,a2\n"
        "  lore-replay --follow trace.csv.gz --task source --out mine.csv     teacher forcing: each row from the "
        "recorded one\n"
        "Exit codes: 0 done, 2 usage, configuration or the name of an input, 1 any other failure.");
    app.set_version_flag("--version", [] { return version_text("lore-replay"); });
    app.add_option("RUN_DIR", arguments.run,
                   "directory of a run; writes trace.csv and trajectory.svg, .png into --out");
    app.add_option("--individual", arguments.individual,
                   "'best', GENERATION.SLOT, or 'failed': the one whose evaluation failed")
        ->capture_default_str();
    take_one_a_time(app.add_option("--kb", arguments.knowledge,
                                   "knowledge base whose values color the trajectory (repeatable: their product)"));
    app.add_option("--actions", arguments.actions,
                   "CSV with the columns a0, a1, a2: drives the robot of an arena open loop");
    app.add_option("--follow", arguments.follow,
                   "recorded trace of an arena (.csv or .csv.gz): repeats each row from its recorded state");
    app.add_option("--task", arguments.task, "task of the arena, for --actions and --follow: source or target");
    app.add_option("--arena", arguments.arena, "arena file or built-in name, for --actions and --follow")
        ->capture_default_str();
    app.add_option("--out", arguments.out, "what to write: a directory for RUN_DIR, else a CSV file")->required();
    app.add_flag("-q,--quiet", arguments.quiet, "say nothing but errors");
    if (auto const only = parse_command_line(app, argc, argv)) return *only;

    int const given = !arguments.run.empty() + !arguments.actions.empty() + !arguments.follow.empty();
    if (given != 1)
        throw UsageError("cannot read the command line",
                         given == 0 ? "nothing to replay" : "more than one thing to replay",
                         "Give one of RUN_DIR, --actions and --follow.");
    if (!arguments.run.empty()) {
        if (!arguments.task.empty() || app.count("--arena") > 0)
            throw UsageError("cannot read the command line", "a run knows its own world and task",
                             "Leave --task and --arena out.");
        replay_run(arguments);
    } else {
        if (arguments.task.empty())
            throw UsageError("cannot read the command line", "--actions and --follow need a task",
                             "Add --task source or --task target.");
        if (!arguments.knowledge.empty() || app.count("--individual") > 0)
            throw UsageError("cannot read the command line", "--kb and --individual go with a run", "Give RUN_DIR.");
        replay_file(arguments);
    }
    return static_cast<int>(ExitCode::done);
}

}   // namespace

int main(int argc, char** argv) {
    return lore::run_program("lore-replay", [&] { return run(argc, argv); });
}
