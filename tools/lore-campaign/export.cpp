#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/interchange/iohprofiler.h>

namespace lore::campaign_program {

namespace {

void export_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    app.add_option("--format", "iohanalyzer: the format of IOHprofiler")   // the only one
        ->type_name("TEXT")
        ->default_str("iohanalyzer")
        ->check(CLI::IsMember({"iohanalyzer"}));
    app.add_option("--out", arguments.out, "a new directory for it")->required()->type_name("DIR");
}

ExitCode export_runs(Arguments const& arguments) {
    ExportCounts const counts =
        export_iohprofiler(read_campaign(arguments.file), CampaignDirectory{arguments.directory}, arguments.out);
    if (!arguments.quiet)
        fmt::print("{}: {} treatments as algorithms, {} runs\n", arguments.out, counts.treatments, counts.runs);
    return ExitCode::done;
}

}   // namespace

Subcommand const export_results{"export", "the finished runs in the format of another program", export_options,
                                export_runs};

}   // namespace lore::campaign_program
