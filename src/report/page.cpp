#include "page.h"

#include "chart.h"
#include "panels.h"
#include "html.h"
#include "page_parts.h"
#include "report_assets.h"
#include "reward_words.h"

#include <lore/campaign/choice.h>
#include <lore/core/uri.h>
#include <lore/experiment/version.h>

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

/// One command of each kind that evolves or builds, as typed in the campaign's directory beside its configurations.
std::string commands(CampaignPlan plan, Results const& results) {
    plan.directory.clear();
    Choice choice;
    choice.source.clear();   // of all
    for (KnowledgeRow const& base : results.bases)
        if (base.kind == "lineage")
            choice.chosen.push_back({base.knowledge, 0, base.source_run, base.seed, base.reward});
    bool const known = choice.covers(plan);
    std::string text;
    for (Step const& step : steps_of(plan)) {
        if (step.kind == StepKind::choose || step.kind == StepKind::replay || step.run > 1) continue;
        text += shell_text(command_of(plan, CampaignDirectory{""}, Launcher{}, step, known ? &choice : nullptr));
        if (step.kind == StepKind::evolve) {
            Treatment const& treatment = plan.treatment(step.subject);
            if (treatment.runs > 1) text += fmt::format("   # and seeds to {}", seed_of(treatment, treatment.runs));
        }
        text += '\n';
    }
    return text;
}

/// "" if this report does not have the figure. `block`: of the caption. It is part of the page, where its text can be
/// marked, unless words are given that are said for it: then it is an image, which runs no scripts of what others give,
/// such as a world's scene.
std::string figure(Figures const& figures, std::string const& name, std::string_view block, Places const& of_caption,
                   std::string const& said_for_image = "") {
    auto const found = figures.find(name);
    if (found == figures.end()) return "";
    std::string caption = filled(block, of_caption);
    caption.pop_back();   // its line's end
    // In a page a document's own heading has no place, and ids must not repeat.
    std::string const svg =
        !said_for_image.empty()
            ? fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml,{}\">\n", escaped(said_for_image),
                          percent_encoded(found->second))
            : with_own_ids(found->second.substr(found->second.find("<svg")), fmt::format("{}-", name));
    return filled("figure", {{"name", name}, {"svg", svg}, {"caption", caption}});
}

/// Of the rewards on all target tasks.
RewardWords words_of(CampaignPlan const& plan, Results const& results) {
    return results.has_several_units(plan) ? words_of_any_reward() : reward_words(results.reward_unit(plan));
}

/// What a caption says of treatments that have no place on its axis; "" if there are none.
std::string left_out(CampaignPlan const& plan, Results const& results) {
    std::vector<std::string> const labels = labels_of_other_units(plan, results);
    return labels.empty() ? ""
                          : escaped(fmt::format("Left out, as rewards of another unit: {}.", fmt::join(labels, ", ")));
}

/// Tables show all treatments, whatever the figures show.
CampaignPlan with_all_shown(CampaignPlan plan) {
    plan.figures.figure3.clear();
    return plan;
}

/// After a sentence.
std::string after_space(std::string const& sentence) { return sentence.empty() ? "" : ' ' + sentence; }

/// What the caption of figure 3 says of source tasks; "" if the figure shows none.
std::string sources_in_figure(TaskPart const& part, RewardWords const& words) {
    std::size_t const sources = drawn_sources(part.plan, part.results);
    if (sources == 0) return "";
    return fmt::format("The gray dashed {}, {}.", sources == 1 ? "line is the source task" : "lines are source tasks",
                       words.source);
}

/// Figures 3 and 4, of each target task.
std::string curves(std::vector<TaskPart> const& parts, Figures const& figures) {
    std::string text;
    for (TaskPart const& part : parts) {
        RewardWords const words = reward_words(part.results.reward_unit(part.plan));
        Places const places{{"number_of", escaped(capital(words.number_of))},
                            {"collected", escaped(capital(words.collected))},
                            {"sources", after_space(sources_in_figure(part, words))},
                            {"left_out", after_space(left_out(part.plan, part.results))},
                            {"task", escaped(part.label)}};
        std::string_view const of_task = part.task.empty() ? "" : "_task";
        for (std::string const name : {"figure3", "figure4"})
            text += figure(figures, part.figure(name), fmt::format("{}{}", name, of_task), places);
    }
    return text;
}

std::string matrix(CampaignPlan const& plan, std::vector<MatrixField> const& fields, Figures const& figures) {
    if (fields.empty()) return "";
    auto const shown =
        std::count_if(fields.begin(), fields.end(), [](MatrixField const& field) { return field.why.empty(); });
    Places const caption{{"fields", std::to_string(shown)},
                         {"n", count_text(fields, &MatrixField::n)},
                         {"n_none", count_text(fields, &MatrixField::n_none)},
                         {"misfit", capital(misfit_word)}};
    return filled("matrix_section",
                  {{"figure", figure(figures, "matrix", "matrix", caption)}, {"table", matrix_table(plan, fields)}});
}

std::string significance(CampaignPlan const& plan, Results const& results, std::vector<Comparison> const& comparisons) {
    if (comparisons.empty()) return "";
    if (!plan.tasks.empty())
        return filled("significance_tasks", {{"pairs", pairs_table(plan, comparisons, "pairs", Spacing::dense)}});
    RewardWords const words = reward_words(results.reward_unit(plan));
    std::string const square = p_value_square(plan, comparisons);
    bool const has_untested = square.find("<td>-</td>") != std::string::npos;
    return filled("significance",
                  {{"gets_more", escaped(words.gets_more)},
                   {"untested", has_untested ? " -: not tested, as the rewards have different units." : ""},
                   {"square", square},
                   {"pairs", pairs_table(plan, comparisons)}});
}

std::string pools(CampaignPlan const& plan, Results const& results, std::vector<Comparison> const& planned) {
    if (plan.pools.empty()) return "";
    std::string const tests =
        planned.empty() ? "" : filled("planned", {{"planned", pairs_table(plan, planned, "planned", Spacing::dense)}});
    return filled("pools", {{"collected", escaped(capital(words_of(plan, results).collected))},
                            {"pools", pools_table(plan, results)},
                            {"planned", tests}});
}

/// A page without a dense table has the style of before there was one.
std::string style(CampaignPlan const& plan, Results const& results) {
    bool const plain = results.speeds.empty() && plan.pools.empty() && plan.tasks.empty();
    return std::string{report_css} + (plain ? "" : filled("dense", {}));
}

std::string bases(CampaignPlan const& plan, Results const& results) {
    return results.bases.empty()
               ? ""
               : filled("bases", {{"noun", std::string{results.reward_word()}}, {"bases", bases_table(plan, results)}});
}

std::string populations(CampaignPlan const& plan, Results const& results) {
    return results.populations.empty() ? ""
                                       : filled("population", {{"noun", std::string{results.reward_word()}},
                                                               {"populations", populations_table(plan, results)}});
}

/// A table a target task: levels and lengths are those of the task.
std::string speeds_by_task(std::vector<TaskPart> const& parts, std::string leads) {
    std::string tables;
    for (TaskPart const& part : parts) {
        if (part.results.speeds.empty()) continue;
        std::string const others = left_out(with_all_shown(part.plan), part.results);
        tables += filled("speed_task",
                         {{"task", part.task.empty() ? "Treatments without a named task" : escaped(part.label)},
                          {"left_out", others.empty() ? "" : filled("speed_task_left_out", {{"left_out", others}})},
                          {"unit", escaped(part.results.reward_unit(part.plan))},
                          {"generations", std::to_string(part.results.speeds.front().generations)},
                          {"speeds", speeds_table(part.plan, part.results, fmt::format("speeds-{}", part.task))}});
    }
    return filled("speed_tasks", {{"speeds", tables}, {"leads", std::move(leads)}});
}

std::string speeds(CampaignPlan const& plan, Results const& results, std::vector<TaskPart> const& parts) {
    if (results.speeds.empty()) return "";
    RewardWords const words = words_of(plan, results);
    Places const of_words{{"noun", words.noun}, {"unit", escaped(words.unit)}};
    Places of_leads = of_words;
    of_leads["leads"] = leads_table(plan, results);
    std::string const leads = results.leads.empty() ? "" : filled("leads", of_leads);
    if (!plan.tasks.empty()) return speeds_by_task(parts, leads);
    std::vector<std::string> levels;
    for (TimeToLevel const& to : results.speeds.front().to) levels.push_back(reward_text(to.level));
    std::string const generations = std::to_string(results.speeds.front().generations);
    std::string times;   // there are none where all runs end with the same reward
    if (!levels.empty()) {
        times = filled("speed_times", {{"levels", fmt::format("{}", fmt::join(levels, ", "))},
                                       {"so_much", words.so_much},
                                       {"generations", generations}});
        times.back() = ' ';   // its line's end
    }
    return filled("speed", {{"noun", words.noun},
                            {"unit", escaped(words.unit)},
                            {"times", times},
                            {"left_out", after_space(left_out(with_all_shown(plan), results))},
                            {"generations", generations},
                            {"speeds", speeds_table(plan, results)},
                            {"leads", leads}});
}

std::string versions(Results const& results) {
    std::set<std::string> versions;
    for (RunRow const& run : results.runs)
        if (!run.version.empty()) versions.insert(run.version);
    return versions.empty() ? "of unknown version" : fmt::format("{}", fmt::join(versions, ", "));
}

/// Whether the replays show worlds by their scenes, rather than arenas.
bool shows_worlds(Results const& results) {
    return results.replays.empty() ? results.reward_word() != first_reward_unit : !all_in_arenas(results.replays);
}

}   // namespace

std::string what_is_missing(CampaignPlan const& plan, Results const& results) {
    if (plan.figures.trajectory.empty() || !results.replays.empty()) return "";
    return fmt::format("Figures 5 and 6 and the replay are missing: the step 'replay' has not written scene.json yet. "
                       "Call 'lore-campaign report' again once '{}' has its source run, or keep scene.json beside the "
                       "tables.",
                       plan.figures.trajectory);
}

std::string report_page(CampaignPlan const& plan, Results const& results, Findings const& findings,
                        Figures const& figures) {
    RewardWords const words = words_of(plan, results);
    auto const runs = static_cast<std::size_t>(planned_runs(plan));
    std::string const missing = what_is_missing(plan, results);
    std::string const trajectory = results.replays.empty() ? "" : escaped(results.replays.front().run);
    BuildInformation const build = build_information();
    bool const worlds = shows_worlds(results);
    auto const panels = [&](std::string const& name, Places const& of_caption) {
        return figure(figures, name, name, of_caption,
                      worlds && figures.contains(name) ? panels_title(plan, results, name) : "");
    };
    // A new part is a function here, a place in page.html.in, and a block there for what stands around it.
    return filled("page", {{"title", escaped(plan.title)},
                           {"css", style(plan, results)},
                           {"js", std::string{report_js} + std::string{worlds ? world_replay_js : arena_replay_js}},
                           {"finished", std::to_string(results.runs.size())},
                           {"planned", std::to_string(runs)},
                           {"generation", std::to_string(results.last_generation())},
                           {"incomplete", results.runs.size() < runs ? filled("incomplete", {}) : ""},
                           {"missing", missing.empty() ? "" : filled("missing", {{"what", escaped(missing)}})},
                           {"matrix", matrix(plan, findings.matrix, figures)},
                           {"collected", escaped(capital(words.collected))},
                           {"treatments", treatments_table(plan, results)},
                           {"curves", curves(findings.parts, figures)},
                           {"speed", speeds(plan, results, findings.parts)},
                           {"pools", pools(plan, results, findings.planned)},
                           {"significance", significance(plan, results, findings.comparisons)},
                           {"bases", bases(plan, results)},
                           {"figure5", panels("figure5", {{"run", trajectory}})},
                           {"figure6", panels("figure6", {})},
                           {"replay", replay_section(plan, results)},
                           {"population", populations(plan, results)},
                           {"runs", runs_table(plan, results)},
                           {"versions", escaped(versions(results))},
                           {"build", escaped(fmt::format("{} ({}), {}", build.version, build.commit, build.compiler))},
                           {"commands", escaped(commands(plan, results))}});
}

}   // namespace lore
