#include <lore/report/report.h>

#include "chart.h"
#include "page.h"
#include "panels.h"
#include "summary.h"

#include <lore/archive/atomic_file.h>
#include <lore/campaign/state.h>
#include <lore/core/directory.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/input_file.h>
#include <lore/figure/svg.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

namespace lore {

namespace {

/// The CSV files may be those of another campaign: every name in them must be known.
void check_names(CampaignPlan const& plan, Results const& results) {
    auto const check_treatment = [&](std::string_view file, std::string_view name) {
        if (plan.is_source(name) ||
            std::find(plan.report_order.begin(), plan.report_order.end(), name) != plan.report_order.end())
            return;
        throw Error(fmt::format("cannot report with {}", plan.path),
                    fmt::format("{} tells of a treatment '{}' that it does not know", file, name),
                    "Use the campaign's file that made these results.");
    };
    for (RunRow const& row : results.runs) check_treatment("final.csv", row.treatment);
    for (CurveRow const& row : results.curves)
        if (plan.pool(row.treatment) == nullptr) check_treatment("curves.csv", row.treatment);
    for (PopulationRow const& row : results.populations) check_treatment("population.csv", row.treatment);
    for (SpeedRow const& row : results.speeds) check_treatment("speed.csv", row.treatment);
    for (LeadRow const& row : results.leads)
        for (std::string const& name : {row.treatment, row.policy, row.none}) check_treatment("leads.csv", name);
    for (Replay const& replay : results.replays)
        check_treatment("replay.csv", std::string_view{replay.run}.substr(0, replay.run.find('/')));
}

/// Rewards of different units cannot be taken together.
void check_pools(CampaignPlan const& plan, Results const& results) {
    for (PoolPlan const& pool : plan.pools) {
        std::string const* first = nullptr;
        for (RunRow const& run : results.runs) {
            if (std::find(pool.treatments.begin(), pool.treatments.end(), run.treatment) == pool.treatments.end())
                continue;
            if (first == nullptr) first = &run.reward_unit;
            if (run.reward_unit != *first)
                throw UsageError(fmt::format("{}: pool '{}' cannot be reported", plan.path, pool.name),
                                 fmt::format("some of its rewards are {}, and those of '{}' {}", *first, run.treatment,
                                             run.reward_unit),
                                 "Pool treatments of one unit.");
        }
    }
}

/// Throws Error or UsageError for results that cannot be reported by this plan.
void check_results(CampaignPlan const& plan, Results const& results) {
    check_names(plan, results);
    check_pools(plan, results);
}

/// Empty tables would take the place of those of the campaign that the runs belong to.
void refuse_others(CampaignPlan const& plan, CampaignDirectory const& from) {
    for (auto const& [step, state] : states_of(plan, from))
        if (state.other)
            throw UsageError(fmt::format("no run in {} is one of {}", from.path(), plan.path),
                             fmt::format("{}: {}", step.name, state.reason),
                             "Give the campaign that it was made with.");
}

/// Makes the tables from the runs. What cannot be reported, or has a damaged replay beside it, replaces no table.
void make_tables(CampaignPlan const& plan, CampaignDirectory const& from, CampaignDirectory const& into) {
    Results results = collect_results(plan, from);
    if (results.runs.empty()) refuse_others(plan, from);
    if (!plan.figures.trajectory.empty()) results.replays = read_replays(into).replays;
    check_results(plan, results);
    write_results(into, results);
}

void write_text(CampaignDirectory const& into, std::string_view name, std::string const& text) {
    write_file_atomically(into.file(name), std::string_view{text});
}

Figures draw_figures(CampaignPlan const& plan, Results const& results, Findings const& findings) {
    Figures figures;
    for (TaskPart const& part : findings.parts) {
        figures[part.figure("figure3")] = draw_curves(part.plan, part.results);
        auto compared = part.comparisons;
        compared.insert(compared.end(), findings.planned.begin(), findings.planned.end());
        figures[part.figure("figure4")] = draw_boxplots(part.plan, part.results, compared);
    }
    if (!findings.matrix.empty()) figures["matrix"] = draw_matrix(plan, findings.matrix);
    for (std::string const figure : {"figure5", "figure6"})
        if (auto svg = draw_panels(plan, results, figure); !svg.empty()) figures[figure] = std::move(svg);
    return figures;
}

/// Names of the figures that the report in a directory can have.
std::set<std::string> figures_of_report(CampaignDirectory const& directory) {
    std::set<std::string> names{"matrix", "figure3", "figure4", "figure5", "figure6"};
    std::string const summary = directory.file("summary.json");
    if (!std::filesystem::exists(summary)) return names;
    for (std::string const& task : tasks_in_summary(read_text(summary)))
        for (std::string_view const figure : {"figure3", "figure4"}) names.insert(fmt::format("{}_{}", figure, task));
    return names;
}

/// `former`: names of the figures of a report that was there before.
void write_figures(std::set<std::string> const& former, CampaignDirectory const& into, Figures const& figures,
                   std::map<std::string, std::string> const& pngs) {
    // Those that this report does not have would pass for its own.
    for (DirectoryEntry const& entry : entries_in(into.file("figures"))) {
        std::filesystem::path const path{entry.path};
        std::string const name = path.stem().string();
        bool const is_picture = path.extension() == ".svg" || path.extension() == ".png";
        if (is_picture && former.contains(name) && !figures.contains(name)) remove_file(entry.path);
    }
    for (auto const& [name, svg] : figures) {
        write_text(into, fmt::format("figures/{}.svg", name), svg);
        write_text(into, fmt::format("figures/{}.png", name), pngs.at(name));
    }
}

/// A table of a former campaign's file that had pools would pass for this one's.
void write_pools(CampaignPlan const& plan, CampaignDirectory const& into, std::vector<Comparison> const& planned) {
    if (!plan.pools.empty()) write_text(into, "pools.csv", pools_csv(planned));
    else remove_file(into.file("pools.csv"));
}

/// Likewise.
void write_matrix(CampaignDirectory const& into, std::vector<MatrixField> const& fields) {
    if (!fields.empty()) write_text(into, "matrix.csv", matrix_csv(fields));
    else remove_file(into.file("matrix.csv"));
}

}   // namespace

std::string write_report(CampaignPlan const& given, CampaignDirectory const& from, CampaignDirectory const& into) {
    std::error_code ignored;   // what cannot be looked at is as good as not there
    bool const has_runs = std::filesystem::exists(from.file("runs"), ignored);
    if (!has_runs && !std::filesystem::exists(from.file("final.csv"), ignored))
        throw UsageError(fmt::format("there is nothing to report in {}", from.path()), "neither runs nor a final.csv",
                         "Start with 'lore-campaign run', or check --dir.");
    make_directory(into.file("figures"));
    if (has_runs) make_tables(given, from, into);
    Results results = read_results(has_runs ? into : from);
    if (given.figures.trajectory.empty()) {   // else it would show what the campaign no longer asks for
        results.replays.clear();
        results.panels.clear();
    }
    CampaignPlan const plan = has_runs ? given : without_misfits(given, results);
    if (!has_runs) check_results(plan, results);
    Findings const findings = findings_of(plan, results);
    // All before the first is written: a report half of which is of a former one would pass for a whole one.
    Figures const figures = draw_figures(plan, results, findings);
    std::map<std::string, std::string> pngs;
    for (auto const& [name, svg] : figures) pngs[name] = render_png(svg);
    std::set<std::string> const former = figures_of_report(into);
    std::string const summary = summary_json(plan, results, findings),
                      page = report_page(plan, results, findings, figures);
    write_text(into, "pvalues.csv", comparisons_csv(findings.comparisons));
    write_pools(plan, into, findings.planned);
    write_matrix(into, findings.matrix);
    write_text(into, "summary.json", summary);
    write_figures(former, into, figures, pngs);
    write_text(into, "report.html", page);
    return what_is_missing(plan, results);
}

}   // namespace lore
