#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/campaign/replay_step.h>

namespace lore::campaign_program {

namespace {

void replay_options(CLI::App& app, Arguments& arguments) { add_campaign(app, arguments); }

ExitCode replay_champions(Arguments const& arguments) {
    CampaignDirectory const directory{arguments.directory};
    make_replays(read_campaign(arguments.file), directory, directory);
    if (!arguments.quiet) fmt::print("{}\n", directory.file("scene.json"));
    return ExitCode::done;
}

}   // namespace

Subcommand const replay{"replay", "simulate what figures 5 and 6 show: the last step of `run`", replay_options,
                        replay_champions};

}   // namespace lore::campaign_program
