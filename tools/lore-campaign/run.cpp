#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/campaign/worlds.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <thread>

#include <unistd.h>

namespace lore::campaign_program {

namespace {

/// Whether the shell's rules find a program of this name.
bool is_program(std::string const& name) {
    if (name.find('/') != std::string::npos) return ::access(name.c_str(), X_OK) == 0;
    char const* const path = std::getenv("PATH");
    std::istringstream folders{path == nullptr ? "/bin:/usr/bin" : path};
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access(fmt::format("{}/{}", folder.empty() ? "." : folder, name).c_str(), X_OK) == 0) return true;
    return false;
}

void run_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    add_launcher(app, arguments);
    app.add_option("-j,--jobs", arguments.jobs, "steps at a time (default: cores / ranks)")
        ->check(CLI::Range(1, 100000));
    app.add_option("--only", arguments.runner.only,
                   "one or more steps or groups, and no others: source, source/007, knowledge/kb1");
}

/// Found before the first run fails for it.
void refuse_missing_launcher(Launcher const& launcher) {
    if (launcher.ranks < 2) return;
    if (launcher.launch.find(Launcher::ranks_mark) == std::string::npos)
        throw UsageError(fmt::format("cannot start runs of {} ranks", launcher.ranks),
                         fmt::format("'{}' does not say where their number belongs", launcher.launch),
                         "Write {ranks} there, such as --launch 'srun --ntasks={ranks}'.");
    std::string const name = launcher.launch.substr(0, launcher.launch.find(' '));
    if (is_program(name)) return;
    throw UsageError(fmt::format("cannot start runs of {} ranks", launcher.ranks),
                     fmt::format("there is no program '{}'", name),
                     "Install MPI (on Debian, the package openmpi-bin), name another launcher with --launch, or leave "
                     "out --ranks.");
}

void refuse_missing_programs(std::string const& folder) {
    for (char const* const program : {"lore-evolve", "lore-kb"})
        if (!folder.empty() && !is_program(folder + "/" + program))
            throw UsageError(fmt::format("cannot start {}", program), fmt::format("there is none in {}", folder),
                             "Name the folder of Lore's programs with --programs.");
}

ExitCode run_steps(Arguments const& arguments) {
    RunnerOptions options = arguments.runner;
    refuse_missing_launcher(options.launcher);
    refuse_missing_programs(options.launcher.programs);
    int const cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    options.jobs = arguments.jobs > 0 ? arguments.jobs : std::max(1, cores / options.launcher.ranks);
    options.quiet = arguments.quiet;
    CampaignPlan const campaign = read_campaign(arguments.file);
    check_worlds(campaign);
    return run_campaign(campaign, CampaignDirectory{arguments.directory}, options);
}

}   // namespace

Subcommand const run{"run",
                     "work through the steps on this machine; finished ones are skipped, interrupted ones resumed",
                     run_options, run_steps};

}   // namespace lore::campaign_program
