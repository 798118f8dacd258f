#include "transfer.h"

#include "knowledge_tables.h"
#include "opened_channels.h"
#include "plan_reading.h"

#include <lore/core/error.h>

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

constexpr std::string_view nothing = "none";   ///< in place of a source's name

TreatmentInput const& read_method(TomlTable const& table) {
    std::string const wanted = table.required_string("method");
    std::vector<std::string_view> words;
    for (TreatmentInput const& input : treatment_inputs()) {
        if (input.method == wanted) return input;
        words.push_back(input.method);
    }
    table.fail("method", fmt::format("there is no method '{}'", wanted),
               fmt::format("Choose one of {}.", fmt::join(words, ", ")));
}

/// The base whose name the treatments give to their input.
std::string base_of(TransferRequest const& request, Treatment const& source) {
    return request.top > 0 ? source.name + "_best" : source.name;
}

Treatment treatment_of(Treatment const& task, std::string_view source, std::string_view with) {
    Treatment treatment = task;
    treatment.name = fmt::format("{}_from_{}", task.name, source);
    treatment.label = fmt::format("{}: {}", task.label, with);
    return treatment;
}

/// Of each, in their order; nothing of a world that cannot be opened.
std::vector<std::optional<Channels>> channels_of(std::vector<Treatment> const& treatments, OpenedChannels& opened) {
    std::vector<std::optional<Channels>> all;
    for (Treatment const& treatment : treatments) {
        all.emplace_back();
        try {
            all.back() = opened.of(treatment);
        } catch (Error const&) {}   // check_worlds says so before the first run
    }
    return all;
}

/// Whether the seeds and all settings but the generations are such that runs of the two are partly the same runs.
bool repeat_each_other(CampaignPlan const& plan, Treatment const& a, Treatment const& b) {
    bool const apart =
        seed_of(a, a.runs) < seed_of(b, 1) || seed_of(b, b.runs) < seed_of(a, 1) || a.runs == 0 || b.runs == 0;
    if (apart || plan.config_path(a) != plan.config_path(b)) return false;
    ExperimentConfig const of_a = read_config(plan.config_path(a), a.overrides);
    ExperimentConfig of_b = read_config(plan.config_path(b), b.overrides);
    of_b.evolution.generations = of_a.evolution.generations;
    return differing_result_settings(of_a, of_b).empty();
}

/// A source run that a base comes from must not count as one without knowledge.
void refuse_source_runs_as_targets(TransferRequest const& request, CampaignPlan const& plan) {
    for (Treatment const& task : plan.tasks)
        for (Treatment const& source : plan.sources)
            if (repeat_each_other(plan, source, task))
                request.table.fail(
                    "method",
                    fmt::format(
                        "runs of target task '{}' would be runs of source '{}' again (same settings, seeds from "
                        "{} and from {})",
                        task.name, source.name, task.first_seed, source.first_seed),
                    fmt::format("Give the target another first_seed, such as {}.", seed_of(source, source.runs) + 1));
}

}   // namespace

std::optional<TransferRequest> read_transfer(TomlTable const& document, CampaignPlan const& plan) {
    auto const table = document.table("transfer");
    if (!table) return std::nullopt;
    if (plan.tasks.empty()) document.fail("transfer", "there is no target task", "Add a table [[target]] for each.");
    for (Treatment const& source : plan.sources)
        if (source.name == nothing)
            document.fail("source", fmt::format("'{}' stands for no knowledge in [transfer]", nothing),
                          "Choose another name.");
    TransferRequest request{*table, &read_method(*table)};
    request.run = static_cast<int>(table->integer("run", 1, most_runs).value_or(0));
    request.top = static_cast<int>(table->integer("top", 1, 100'000'000).value_or(0));
    if (request.top > 0 && request.method->names == &Treatment::policy_of)
        table->fail("top", "a policy takes genomes, not features", "Remove it.");
    table->reject_unknown();
    return request;
}

void add_transfer_bases(TransferRequest const& request, CampaignPlan& plan) {
    for (Treatment const& source : plan.sources) {
        KnowledgePlan base;
        base.name = source.name;
        base.label = source.label;
        base.source = source.name;
        base.run = request.run;
        base.best_run = request.run == 0;
        add_knowledge(request.table, base, plan);
        if (request.top == 0) continue;
        KnowledgePlan best;
        best.kind = KnowledgeKind::reduced;
        best.name = base_of(request, source);
        best.label = fmt::format("best {} of {}", request.top, source.label);
        best.base = source.name;
        best.options = {"--top", std::to_string(request.top)};
        add_knowledge(request.table, best, plan);
    }
}

void add_transfer_treatments(TransferRequest const& request, CampaignPlan& plan) {
    refuse_source_runs_as_targets(request, plan);
    OpenedChannels opened{plan};
    auto const of_sources = channels_of(plan.sources, opened), of_tasks = channels_of(plan.tasks, opened);
    for (std::size_t t = 0; t < plan.tasks.size(); ++t) {
        Treatment const& task = plan.tasks[t];
        Treatment const none = treatment_of(task, nothing, "no knowledge");
        add_treatment(request.table, none, plan);
        for (std::size_t s = 0; s < plan.sources.size(); ++s) {
            Treatment const& source = plan.sources[s];
            TransferPair pair{source.name, task.name, "", none.name, ""};
            if (of_sources[s] && of_tasks[t]) pair.misfit = why_misfit(*of_sources[s], *of_tasks[t]);
            if (pair.misfit.empty()) {
                Treatment helped = treatment_of(task, source.name, fmt::format("from {}", source.label));
                helped.*request.method->names = {base_of(request, source)};
                pair.treatment = helped.name;
                add_treatment(request.table, std::move(helped), plan);
            }
            plan.transfer.push_back(std::move(pair));
        }
    }
    auto const row = [&](TransferPair const& pair) {
        return std::find_if(plan.sources.begin(), plan.sources.end(),
                            [&](Treatment const& source) { return source.name == pair.source; });
    };
    std::stable_sort(plan.transfer.begin(), plan.transfer.end(),
                     [&](TransferPair const& a, TransferPair const& b) { return row(a) < row(b); });
}

}   // namespace lore
