#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/campaign/replay_step.h>
#include <lore/report/report.h>

namespace lore::campaign_program {

namespace {

void report_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    app.add_option("--out", arguments.out, "write them here, not beside the runs (default: --dir)")->type_name("DIR");
}

ExitCode write_report(Arguments const& arguments) {
    CampaignDirectory const from{arguments.directory};
    CampaignDirectory const into{arguments.out.empty() ? arguments.directory : arguments.out};
    CampaignPlan const campaign = read_campaign(arguments.file);
    // The report only reads: what its pictures of trajectories show is simulated before, where that is due.
    if (replay_is_due(campaign, from, into)) make_replays(campaign, from, into);
    std::string const missing = write_report(campaign, from, into);
    if (!arguments.quiet) fmt::print("{}\n", into.file("report.html"));
    if (!arguments.quiet && !missing.empty()) fmt::print("{}\n", missing);
    return ExitCode::done;
}

}   // namespace

Subcommand const report{"report", "tables, figures and report.html from what is there by now", report_options,
                        write_report};

}   // namespace lore::campaign_program
