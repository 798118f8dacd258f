#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/campaign/slurm.h>
#include <lore/campaign/worlds.h>

namespace lore::campaign_program {

namespace {

void submit_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    add_launcher(app, arguments);
    app.add_option(
        "--time", arguments.time_limit,
        "limit of a task: HH:MM:SS; a number alone is minutes, as sbatch reads it (default: the campaign's)");
    app.add_option("--concurrent", arguments.concurrent,
                   "most tasks of a treatment at a time (default: the campaign's)")
        ->check(CLI::Range(1, 100000));
    take_one_a_time(app.add_option("--sbatch", arguments.cluster_options,
                                   "a further #SBATCH option, such as --partition=long (repeatable)"));
    app.add_flag("--only-write", arguments.only_write, "write the scripts, submit nothing");
}

ExitCode submit_steps(Arguments const& arguments) {
    CampaignPlan campaign = read_campaign(arguments.file);
    check_worlds(campaign);
    if (!arguments.time_limit.empty()) campaign.cluster.time_limit = arguments.time_limit;
    if (arguments.concurrent > 0) campaign.cluster.concurrent = arguments.concurrent;
    campaign.cluster.options.insert(campaign.cluster.options.end(), arguments.cluster_options.begin(),
                                    arguments.cluster_options.end());
    Launcher const& launcher = arguments.runner.launcher;
    for (std::string const& line : submit_campaign(campaign, CampaignDirectory{arguments.directory}, launcher,
                                                   launcher.campaign_program, arguments.only_write))
        if (!arguments.quiet) fmt::print("{}\n", line);
    return ExitCode::done;
}

}   // namespace

Subcommand const submit{"submit", "write Slurm job scripts to DIR/slurm for what is not done yet, and submit them",
                        submit_options, submit_steps};

}   // namespace lore::campaign_program
