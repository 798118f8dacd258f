#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/campaign/worlds.h>

#include <algorithm>
#include <thread>

namespace lore::campaign_program {

namespace {

void run_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    add_launcher(app, arguments);
    app.add_option("-j,--jobs", arguments.jobs, "steps at a time (default: cores / ranks)")
        ->check(CLI::Range(1, 100000));
    app.add_option("--only", arguments.runner.only,
                   "only these steps or groups, such as source, source/007 or knowledge/kb1");
}

ExitCode run_steps(Arguments const& arguments) {
    RunnerOptions options = arguments.runner;
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
