// Runs a whole campaign: source runs, knowledge bases, target runs, figures.
//
//   lore-campaign run    jobs/campaigns/small.toml --dir runs/small
//   lore-campaign report jobs/campaigns/small.toml --dir runs/small
//
// The first works through everything and can be stopped and called again; the second writes runs/small/report.html.
// docs/campaigns.md is the how-to, docs/cluster.md the one for batch systems.

#include "program.h"

#include <lore/campaign/choice.h>
#include <lore/campaign/plan.h>
#include <lore/campaign/report.h>
#include <lore/campaign/runner.h>
#include <lore/campaign/slurm.h>
#include <lore/campaign/state.h>
#include <lore/core/error.h>
#include <lore/experiment/version.h>
#include <lore/statistics/bootstrap.h>
#include <lore/statistics/mann_whitney.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

namespace {

using namespace lore;

struct Arguments {
    std::string file, directory;
    RunnerOptions runner;
    std::string time_limit;   ///< of `submit`
    int concurrent = 0;
    std::vector<std::string> cluster_options;
    bool only_write = false;
    std::string out;             ///< of `report`
    std::string first, second;   ///< of `test`
    bool interval = false;
    bool quiet = false;
};

/// The directory of this program, if its companions lie there too; else empty, and the shell finds them.
std::string companions() {
    std::error_code failed;
    auto const here = std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
    return !failed && std::filesystem::exists(here / "lore-evolve") ? here.string() : "";
}

ExitCode plan(Arguments const& arguments) {
    CampaignPlan const campaign = read_campaign(arguments.file);
    CampaignDirectory const directory{arguments.directory};
    auto const choice = recorded_choice(directory);
    bool const usable = choice && choice->covers(campaign);
    fmt::print("# {}\n{:<24} {:<22} {}\n", campaign.title, "step", "waits for", "command");
    for (Step const& step : steps_of(campaign)) {
        auto const command =
            command_of(campaign, directory, arguments.runner.launcher, step, usable ? &*choice : nullptr);
        fmt::print("{:<24} {:<22} {}\n", step.name,
                   step.after.empty() ? "-" : fmt::format("{}", fmt::join(step.after, ",")),
                   command.empty() ? "(source runs for the knowledge bases)" : shell_text(command));
    }
    return ExitCode::done;
}

ExitCode status(Arguments const& arguments) {
    CampaignPlan const campaign = read_campaign(arguments.file);
    CampaignDirectory const directory{arguments.directory};
    std::map<StepStatus, int> counts;
    std::set<std::string> unfinished;   // groups; every step comes after those that it waits for
    for (Step const& step : steps_of(campaign)) {
        StepState state = state_of(campaign, directory, step);
        ++counts[state.status];
        if (state.status != StepStatus::done) unfinished.insert(step.group);
        if (state.status == StepStatus::missing) {
            auto const open = std::find_if(step.after.begin(), step.after.end(),
                                           [&](std::string const& group) { return unfinished.contains(group); });
            state.reason = open == step.after.end() ? "not started" : fmt::format("waits for {}", *open);
        }
        if (!arguments.quiet) fmt::print("{:<24} {:<12} {}\n", step.name, name(state.status), state.reason);
    }
    std::vector<std::string> words;
    for (auto const& [status, count] : counts) words.push_back(fmt::format("{} {}", count, name(status)));
    fmt::print("{}\n", fmt::join(words, ", "));
    return ExitCode::done;
}

ExitCode submit(Arguments const& arguments) {
    CampaignPlan campaign = read_campaign(arguments.file);
    if (!arguments.time_limit.empty()) campaign.cluster.time_limit = arguments.time_limit;
    if (arguments.concurrent > 0) campaign.cluster.concurrent = arguments.concurrent;
    campaign.cluster.options.insert(campaign.cluster.options.end(), arguments.cluster_options.begin(),
                                    arguments.cluster_options.end());
    std::string const self = std::filesystem::read_symlink("/proc/self/exe").string();
    for (std::string const& line : submit_campaign(campaign, CampaignDirectory{arguments.directory},
                                                   arguments.runner.launcher, self, arguments.only_write))
        if (!arguments.quiet) fmt::print("{}\n", line);
    return ExitCode::done;
}

ExitCode report(Arguments const& arguments) {
    CampaignDirectory const from{arguments.directory};
    CampaignDirectory const into{arguments.out.empty() ? arguments.directory : arguments.out};
    write_report(read_campaign(arguments.file), from, into);
    if (!arguments.quiet) fmt::print("{}\n", into.file("report.html"));
    return ExitCode::done;
}

/// One number a line; empty lines do not count.
std::vector<double> read_sample(std::string const& path) {
    std::ifstream file{path};
    if (!file)
        throw UsageError(fmt::format("cannot read {}", path), "no such file, or not readable", "Check the path.");
    std::vector<double> sample;
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        std::size_t const first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos) continue;
        line = line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
        double value = 0;
        auto const [end, failed] = std::from_chars(line.data(), line.data() + line.size(), value);
        if (failed != std::errc{} || end != line.data() + line.size() || std::isnan(value))
            throw UsageError(fmt::format("{}, line {}: '{}' is no number", path, number, line.substr(0, 40)),
                             "one number a line is expected", "Remove headers and other columns.");
        sample.push_back(value);
    }
    if (sample.empty())
        throw UsageError(fmt::format("{} has no number", path), "one number a line is expected", "Check the path.");
    return sample;
}

ExitCode test(Arguments const& arguments) {
    auto const first = read_sample(arguments.first), second = read_sample(arguments.second);
    MannWhitney const result = mann_whitney(first, second);
    fmt::print("U {} p {} A12 {}", result.u, result.p, vargha_delaney_a12(first, second));
    if (arguments.interval) {
        Interval const band = bootstrap_a12(first, second);
        fmt::print(" {} .. {}", band.low, band.high);
    }
    fmt::print("\n");
    return ExitCode::done;
}

int run(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{
        "Runs campaigns from one file: source runs, knowledge bases, target runs, report.\n\n"
        "Examples:\n"
        "  lore-campaign plan   jobs/campaigns/paper.toml --dir runs/paper           what will be done\n"
        "  lore-campaign run    jobs/campaigns/paper.toml --dir runs/paper --jobs 8  do it here, eight runs at a time\n"
        "  lore-campaign submit jobs/campaigns/paper.toml --dir runs/paper           do it on a Slurm cluster\n"
        "  lore-campaign report jobs/campaigns/paper.toml --dir runs/paper           runs/paper/report.html\n"
        "  lore-campaign status jobs/campaigns/paper.toml --dir runs/paper           how far it has come\n"
        "  lore-campaign test   a.csv b.csv                                compare two columns of numbers\n\n"
        "Exit codes: 0 done, 1 something failed, 2 command line or campaign file, 75 interrupted: call it again.",
        "lore-campaign"};
    app.set_version_flag("--version", [] { return version_text("lore-campaign"); });
    app.require_subcommand(1);
    app.fallthrough();
    app.add_flag("-q,--quiet", arguments.quiet, "say only what went wrong");

    auto const on_campaign = [&](std::string const& name, std::string const& what) {
        CLI::App* const command = app.add_subcommand(name, what);
        command->add_option("FILE", arguments.file, "the campaign, such as jobs/campaigns/paper.toml")->required();
        command->add_option("--dir", arguments.directory, "where its runs and results lie")->required();
        return command;
    };
    auto const starts_runs = [&](CLI::App* command) {
        command
            ->add_option("-n,--ranks", arguments.runner.launcher.ranks,
                         "MPI ranks of a run (1: started without mpirun)")
            ->capture_default_str()
            ->check(CLI::Range(1, 100000));
        command->add_option("--launch", arguments.runner.launcher.launch, "how runs of several ranks are started")
            ->capture_default_str();
        command->add_option("--programs", arguments.runner.launcher.programs,
                            "directory of lore-evolve and lore-kb (default: this program's)");
    };

    CLI::App* const plan_command = on_campaign("plan", "list the steps, what each waits for, and its command");
    starts_runs(plan_command);

    CLI::App* const run_command = on_campaign(
        "run", "work through the steps on this machine; finished ones are skipped, interrupted ones resumed");
    starts_runs(run_command);
    int jobs = 0;
    run_command->add_option("-j,--jobs", jobs, "steps at a time (default: cores / ranks)")
        ->check(CLI::Range(1, 100000));
    run_command->add_option("--only", arguments.runner.only,
                            "only these steps or groups, such as source, source/007 or knowledge/kb1");

    CLI::App* const submit_command =
        on_campaign("submit", "write Slurm job scripts to DIR/slurm for what is not done yet, and submit them");
    starts_runs(submit_command);
    submit_command->add_option("--time", arguments.time_limit, "limit of a task, HH:MM:SS (default: the campaign's)");
    submit_command
        ->add_option("--concurrent", arguments.concurrent,
                     "most tasks of a treatment at a time (default: the campaign's)")
        ->check(CLI::Range(1, 100000));
    submit_command->add_option("--sbatch", arguments.cluster_options,
                               "a further #SBATCH option, such as --partition=long; repeatable");
    submit_command->add_flag("--only-write", arguments.only_write, "write the scripts, submit nothing");

    CLI::App* const report_command = on_campaign("report", "tables, figures and report.html from what is there by now");
    report_command->add_option("--out", arguments.out, "write them here, not beside the runs (default: --dir)")
        ->type_name("DIR");

    CLI::App* const status_command =
        on_campaign("status", "done / running / interrupted / failed / missing, with the reason");

    CLI::App* const test_command =
        app.add_subcommand("test", "two-sided Mann-Whitney test of two files with one number a line");
    test_command->add_option("A", arguments.first, "first sample")->required();
    test_command->add_option("B", arguments.second, "second sample")->required();
    test_command->add_flag("--interval", arguments.interval, "also the 95 % bootstrap interval of A12");

    if (auto const only = parse_command_line(app, argc, argv)) return *only;
    arguments.runner.quiet = arguments.quiet;
    if (arguments.runner.launcher.programs.empty()) arguments.runner.launcher.programs = companions();
    int const cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    arguments.runner.jobs = jobs > 0 ? jobs : std::max(1, cores / arguments.runner.launcher.ranks);

    if (*plan_command) return static_cast<int>(plan(arguments));
    if (*run_command)
        return static_cast<int>(
            run_campaign(read_campaign(arguments.file), CampaignDirectory{arguments.directory}, arguments.runner));
    if (*submit_command) return static_cast<int>(submit(arguments));
    if (*report_command) return static_cast<int>(report(arguments));
    if (*status_command) return static_cast<int>(status(arguments));
    if (*test_command) return static_cast<int>(test(arguments));
    return static_cast<int>(ExitCode::usage);
}

}   // namespace

int main(int argc, char** argv) {
    return lore::run_program("lore-campaign", [&] { return run(argc, argv); });
}
