#include "subcommand.h"

#include <lore/campaign/plan.h>
#include <lore/campaign/state.h>
#include <lore/core/column.h>
#include <lore/core/utf8.h>

#include <fmt/ranges.h>

#include <filesystem>
#include <map>

namespace lore::campaign_program {

namespace {

void status_options(CLI::App& app, Arguments& arguments) { add_campaign(app, arguments); }

ExitCode show_status(Arguments const& arguments) {
    CampaignPlan const campaign = read_campaign(arguments.file);
    CampaignDirectory const directory{arguments.directory};
    std::map<StepStatus, int> counts;
    std::vector<StepWithState> const steps = states_of(campaign, directory);
    auto const width = column_width(24, steps, [](StepWithState const& one) { return one.step.name; });
    for (auto const& [step, state] : steps) {
        ++counts[state.status];
        if (!arguments.quiet)
            fmt::print("{:<{}} {:<12} {}\n", step.name, width, name(state.status), harmless(state.reason));
    }
    std::vector<std::string> words;
    for (auto const& [status, count] : counts) words.push_back(fmt::format("{} {}", count, name(status)));
    fmt::print("{}\n", fmt::join(words, ", "));
    if (!std::filesystem::exists(arguments.directory))
        write_stderr(
            fmt::format("lore-campaign: {} is not there yet. 'lore-campaign run' makes it; if it has run, check "
                        "--dir.\n",
                        arguments.directory));
    return ExitCode::done;
}

}   // namespace

Subcommand const status{"status", "done / running / interrupted / failed / missing, with the reason", status_options,
                        show_status};

}   // namespace lore::campaign_program
