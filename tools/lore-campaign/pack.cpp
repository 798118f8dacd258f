#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/campaign/stop_signals.h>
#include <lore/core/utf8.h>
#include <lore/interchange/verify_pack.h>

namespace lore::campaign_program {

namespace {

/// Looks for a signal between pieces of the work.
Pulse stopped_by(StopSignals const& signals) {
    return [&signals] {
        signals.sleep(0);   // lets them in
        if (signals.requests() > 0)
            throw Error("stopped", "a signal asked for it", "Nothing was written; call it again.",
                        ExitCode::interrupted);
    };
}

void pack_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    app.add_option("--out", arguments.out,
                   "the archive, .tar.zst, .tar.gz or .zip (default: describe --dir itself, as it lies there)")
        ->type_name("FILE");
    take_one_a_time(app.add_option("--leave-out", arguments.leave_out,
                                   "individuals (archives of all), checkpoints, bases or logs (repeatable)"));
    PackOptions& pack = arguments.pack;
    app.add_option("--license", pack.license, "of the data: an SPDX identifier, a URL or a sentence");
    take_one_a_time(app.add_option("--author", pack.authors,
                                   "\"Ada Lovelace <https://orcid.org/...>\", or the name alone (repeatable)"));
    app.add_option("--description", pack.description, "what the data are about");
    app.add_option("--date", pack.date, "of publication, YYYY-MM-DD (default: the day the last run ended)");
}

ExitCode pack_directory(Arguments const& arguments) {
    CampaignPlan const campaign = read_campaign(arguments.file);
    CampaignDirectory const directory{arguments.directory};
    PackOptions options = arguments.pack;
    for (std::string const& part : arguments.leave_out) options.leave_out.push_back(pack_part(part));
    StopSignals const signals;
    PackCounts const counts = arguments.out.empty()
                                  ? describe_campaign(campaign, directory, options, stopped_by(signals))
                                  : pack_campaign(campaign, directory, options, arguments.out, stopped_by(signals));
    if (!arguments.quiet)
        fmt::print("{}: {} files, {} bytes before packing; {} left out\n",
                   arguments.out.empty() ? directory.file("ro-crate-metadata.json") : arguments.out, counts.files,
                   counts.bytes, counts.left_out);
    return ExitCode::done;
}

void verify_options(CLI::App& app, Arguments& arguments) {
    app.add_option("PACK", arguments.file,
                   "an archive that `pack` made, or a directory that it described or that one "
                   "was unpacked into")
        ->required();
}

ExitCode verify_archive(Arguments const& arguments) {
    StopSignals const signals;
    PackVerdict const verdict = verify_pack(arguments.file, stopped_by(signals));
    if (verdict.defects.empty()) {
        if (!arguments.quiet)
            fmt::print("{}: '{}', {} files, whole; {} left out\n", arguments.file, harmless(verdict.title),
                       verdict.files, verdict.left_out);
        return ExitCode::done;
    }
    for (std::string const& defect : verdict.defects) write_stderr(harmless(defect) + "\n");
    throw Error(
        fmt::format("{} is not whole", arguments.file),
        fmt::format("{} defect{}, in the lines above", verdict.defects.size(), verdict.defects.size() == 1 ? "" : "s"),
        "Take a copy that is whole.");
}

}   // namespace

Subcommand const pack{"pack", "one archive of all that belongs to the campaign, described as a research object",
                      pack_options, pack_directory};
Subcommand const verify{"verify", "check such an archive: all is there, as described, readable, and nothing else",
                        verify_options, verify_archive};

}   // namespace lore::campaign_program
