#include "page.h"

#include "panels.h"
#include "html.h"
#include "page_parts.h"
#include "report_assets.h"
#include "reward_words.h"

#include <lore/campaign/choice.h>
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

/// "" if this report does not have the figure.
std::string figure(Figures const& figures, std::string const& name, Places const& of_caption = {}) {
    auto const found = figures.find(name);
    if (found == figures.end()) return "";
    std::string caption = filled(name, of_caption);
    caption.pop_back();   // its line's end
    // In a page a document's own heading has no place, and ids must not repeat.
    std::string const svg = with_own_ids(found->second.substr(found->second.find("<svg")), fmt::format("{}-", name));
    return filled("figure", {{"name", name}, {"svg", svg}, {"caption", caption}});
}

std::string significance(CampaignPlan const& plan, Results const& results, std::vector<Comparison> const& comparisons) {
    if (comparisons.empty()) return "";
    RewardWords const words = reward_words(results.reward_unit(plan));
    return filled("significance", {{"gets_more", escaped(words.gets_more)},
                                   {"square", p_value_square(plan, comparisons)},
                                   {"pairs", pairs_table(plan, comparisons)}});
}

std::string pools(CampaignPlan const& plan, Results const& results, std::vector<Comparison> const& planned) {
    if (plan.pools.empty()) return "";
    std::string const tests =
        planned.empty() ? "" : filled("planned", {{"planned", pairs_table(plan, planned, "planned", Spacing::dense)}});
    return filled("pools", {{"collected", escaped(capital(reward_words(results.reward_unit(plan)).collected))},
                            {"pools", pools_table(plan, results)},
                            {"planned", tests}});
}

/// A page without a dense table has the style of before there was one.
std::string style(CampaignPlan const& plan, Results const& results) {
    bool const plain = results.speeds.empty() && plan.pools.empty();
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

std::string speeds(CampaignPlan const& plan, Results const& results) {
    if (results.speeds.empty()) return "";
    RewardWords const words = reward_words(results.reward_unit(plan));
    Places const of_words{{"noun", words.noun}, {"unit", escaped(words.unit)}};
    Places of_leads = of_words;
    of_leads["leads"] = leads_table(plan, results);
    std::string const leads = results.leads.empty() ? "" : filled("leads", of_leads);
    std::vector<std::string> levels;
    for (TimeToLevel const& to : results.speeds.front().to) levels.push_back(reward_text(to.level));
    return filled("speed", {{"noun", words.noun},
                            {"unit", escaped(words.unit)},
                            {"so_much", words.so_much},
                            {"levels", fmt::format("{}", fmt::join(levels, ", "))},
                            {"generations", std::to_string(results.speeds.front().generations)},
                            {"speeds", speeds_table(plan, results)},
                            {"leads", leads}});
}

std::string versions(Results const& results) {
    std::set<std::string> versions;
    for (RunRow const& run : results.runs)
        if (!run.version.empty()) versions.insert(run.version);
    return versions.empty() ? "of unknown version" : fmt::format("{}", fmt::join(versions, ", "));
}

std::size_t planned_runs(CampaignPlan const& plan) {
    std::size_t planned = static_cast<std::size_t>(plan.source.runs);
    for (Treatment const& target : plan.targets) planned += static_cast<std::size_t>(target.runs);
    return planned;
}

/// Whether the replays show worlds by their scenes, rather than arenas.
bool shows_worlds(Results const& results) {
    return results.replays.empty() ? results.reward_word() != first_reward_unit : !all_in_arenas(results.replays);
}

int last_generation(Results const& results) {
    int last = 0;
    for (CurveRow const& row : results.curves) last = std::max(last, row.generation);
    return last;
}

}   // namespace

std::string report_page(CampaignPlan const& plan, Results const& results, std::vector<Comparison> const& comparisons,
                        std::vector<Comparison> const& planned, Figures const& figures) {
    RewardWords const words = reward_words(results.reward_unit(plan));
    std::size_t const runs = planned_runs(plan);
    std::string const missing = what_is_missing(plan, results);
    std::string const trajectory = results.replays.empty() ? "" : escaped(results.replays.front().run);
    BuildInformation const build = build_information();
    // A new part is a function here, a place in page.html.in, and a block there for what stands around it.
    return filled(
        "page",
        {{"title", escaped(plan.title)},
         {"css", style(plan, results)},
         {"js", std::string{report_js} + std::string{shows_worlds(results) ? world_replay_js : arena_replay_js}},
         {"finished", std::to_string(results.runs.size())},
         {"planned", std::to_string(runs)},
         {"generation", std::to_string(last_generation(results))},
         {"incomplete", results.runs.size() < runs ? filled("incomplete", {}) : ""},
         {"missing", missing.empty() ? "" : filled("missing", {{"what", escaped(missing)}})},
         {"collected", escaped(capital(words.collected))},
         {"treatments", treatments_table(plan, results)},
         {"figure3",
          figure(figures, "figure3", {{"number_of", escaped(capital(words.number_of))}, {"source", words.source}})},
         {"figure4", figure(figures, "figure4", {{"collected", escaped(capital(words.collected))}})},
         {"speed", speeds(plan, results)},
         {"pools", pools(plan, results, planned)},
         {"significance", significance(plan, results, comparisons)},
         {"bases", bases(plan, results)},
         {"figure5", figure(figures, "figure5",
                            {{"run", trajectory}, {"not_found", shows_worlds(results) ? "" : " (-1: not found)"}})},
         {"figure6",
          figure(figures, "figure6", {{"not_found", shows_worlds(results) ? "" : " (0: not found in one of them)"}})},
         {"replay", replay_section(plan, results)},
         {"population", populations(plan, results)},
         {"runs", runs_table(plan, results)},
         {"versions", escaped(versions(results))},
         {"build", escaped(fmt::format("{} ({}), {}", build.version, build.commit, build.compiler))},
         {"commands", escaped(commands(plan, results))}});
}

}   // namespace lore
