// Runs a whole campaign: source runs, knowledge bases, target runs, figures.
//
//   lore-campaign run    jobs/campaigns/small.toml --dir runs/small
//   lore-campaign report jobs/campaigns/small.toml --dir runs/small
//
// The first works through everything and can be stopped and called again; the second writes runs/small/report.html.
// docs/manual/campaigns.md is the how-to, docs/manual/cluster.md the one for batch systems.

#include "subcommand.h"

#include <lore/core/installation.h>
#include <lore/experiment/run_directory.h>
#include <lore/experiment/version.h>

#include <array>
#include <filesystem>

namespace lore::campaign_program {

void add_campaign(CLI::App& app, Arguments& arguments) {
    app.add_option("FILE", arguments.file, "the campaign, such as jobs/campaigns/paper.toml")->required();
    app.add_option("--dir", arguments.directory, "where its runs and results lie")->required();
}

void add_launcher(CLI::App& app, Arguments& arguments) {
    Launcher& launcher = arguments.runner.launcher;
    app.add_option("-n,--ranks", launcher.ranks, "MPI ranks of a run (1: started without mpirun)")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    app.add_option("--launch", launcher.launch, "how runs of several ranks are started")->capture_default_str();
    app.add_option("--programs", launcher.programs, "directory of lore-evolve and lore-kb (default: this program's)");
}

namespace {

constexpr char help[] =
    "Runs campaigns from one file: source runs, knowledge bases, target runs, report.\n\n"
    "Examples:\n"
    "  lore-campaign plan   jobs/campaigns/paper.toml --dir runs/paper           what will be done\n"
    "  lore-campaign run    jobs/campaigns/paper.toml --dir runs/paper --jobs 8  do it here, eight runs at a time\n"
    "  lore-campaign submit jobs/campaigns/paper.toml --dir runs/paper           do it on a Slurm cluster\n"
    "  lore-campaign report jobs/campaigns/paper.toml --dir runs/paper           runs/paper/report.html\n"
    "  lore-campaign status jobs/campaigns/paper.toml --dir runs/paper           how far it has come\n"
    "  lore-campaign watch  jobs/campaigns/paper.toml --dir runs/paper           the same in a browser, all the time\n"
    "  lore-campaign events runs/paper --follow                                  what happens, as JSON Lines, for "
    "trackers\n"
    "  lore-campaign export jobs/campaigns/paper.toml --dir runs/paper --out ioh for IOHanalyzer\n"
    "  lore-campaign pack   jobs/campaigns/paper.toml --dir runs/paper --out paper.tar.zst --license CC-BY-4.0\n"
    "  lore-campaign verify paper.tar.zst                                        whether all of it is there and right\n"
    "  lore-campaign test   a.csv b.csv                                compare two columns of numbers\n\n"
    "Exit codes: 0 done, 1 something failed, 2 command line or campaign file, 75 interrupted: call it again.";

/// The directory of this program, if its companions lie there too; else empty, and the shell finds them.
std::string companions() {
    auto const here = std::filesystem::path{own_program()}.parent_path();
    return !here.empty() && std::filesystem::exists(here / "lore-evolve") ? here.string() : "";
}

/// A run has a manifest where a campaign has none; what is not there yet can be made or waited for.
void refuse_other_than_campaign(std::string const& directory) {
    if (std::filesystem::exists(directory) && !std::filesystem::is_directory(directory))
        throw UsageError(fmt::format("{} is no directory of a campaign", directory), "it is a file", "Check --dir.");
    if (!directory.empty() && std::filesystem::exists(std::filesystem::path{directory} / run_file::manifest))
        throw UsageError(fmt::format("{} is no directory of a campaign", directory), "it holds a run of lore-evolve",
                         "Give another with --dir; 'lore-campaign run' makes it.");
}

int start(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{help, "lore-campaign"};
    app.set_version_flag("--version", [] { return version_text("lore-campaign"); });
    app.require_subcommand(1);
    app.fallthrough();
    app.add_flag("-q,--quiet", arguments.quiet, "say only what went wrong");

    std::array const subcommands{&plan,  &run,    &submit,         &report, &replay, &status,
                                 &watch, &events, &export_results, &pack,   &verify, &test};
    for (Subcommand const* const subcommand : subcommands)
        subcommand->add_options(*app.add_subcommand(subcommand->name, subcommand->description), arguments);

    if (auto const only = parse_command_line(app, argc, argv)) return *only;
    if (!app.got_subcommand(events.name)) refuse_other_than_campaign(arguments.directory);   // events are of a run, too
    if (std::string const self = own_program(); !self.empty()) arguments.runner.launcher.campaign_program = self;
    if (arguments.runner.launcher.programs.empty()) arguments.runner.launcher.programs = companions();
    for (Subcommand const* const subcommand : subcommands)
        if (app.got_subcommand(subcommand->name)) return static_cast<int>(subcommand->work(arguments));
    return static_cast<int>(ExitCode::usage);
}

}   // namespace

}   // namespace lore::campaign_program

int main(int argc, char** argv) {
    return lore::run_program("lore-campaign", [&] { return lore::campaign_program::start(argc, argv); });
}
