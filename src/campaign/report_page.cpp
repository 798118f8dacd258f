#include <lore/campaign/report.h>

#include "report_assets.h"

#include <lore/arena/arena.h>
#include <lore/campaign/chart.h>
#include <lore/campaign/choice.h>
#include <lore/experiment/config.h>
#include <lore/experiment/version.h>
#include <lore/statistics/quantiles.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

std::string escaped(std::string_view text) {
    std::string out;
    for (char const c : text) {
        if (c == '<') out += "&lt;";
        else if (c == '>') out += "&gt;";
        else if (c == '&') out += "&amp;";
        else if (c == '"') out += "&quot;";
        else out += c;
    }
    return out;
}

struct Heading {
    std::string text;
    bool is_text = false;
};

/// A table whose headings sort it.
class HtmlTable {
public:
    HtmlTable(std::string_view id, std::vector<Heading> headings) : headings_(std::move(headings)) {
        html_ = fmt::format("<div class=\"scroll\"><table class=\"sortable\" id=\"{}\"><thead><tr>", id);
        for (Heading const& h : headings_)
            html_ += fmt::format("<th scope=\"col\"{}><button type=\"button\">{}</button></th>",
                                 h.is_text ? " class=\"text\"" : "", escaped(h.text));
        html_ += "</tr></thead><tbody>\n";
    }
    /// `cells` as shown; `values` what they are sorted by where that differs (same length, or empty).
    void row(std::vector<std::string> const& cells, std::vector<std::string> const& values = {}) {
        html_ += "<tr>";
        for (std::size_t c = 0; c < cells.size(); ++c)
            html_ += fmt::format(
                "<td{}{}>{}</td>", headings_[c].is_text ? " class=\"text\"" : "",
                values.empty() || values[c].empty() ? "" : fmt::format(" data-value=\"{}\"", escaped(values[c])),
                escaped(cells[c]));
        html_ += "</tr>\n";
    }
    std::string finish() && { return std::move(html_) + "</tbody></table></div>\n"; }

private:
    std::vector<Heading> headings_;
    std::string html_;
};

std::string treatments_table(CampaignPlan const& plan, Results const& results) {
    HtmlTable table{"treatments",
                    {{"treatment", true},
                     {"runs"},
                     {"planned"},
                     {"mean"},
                     {"sd"},
                     {"least"},
                     {"Q1"},
                     {"median"},
                     {"Q3"},
                     {"most"}}};
    auto add = [&](Treatment const& treatment) {
        auto const balls = results.final_balls(treatment.name);
        std::vector<std::string> cells{treatment.label, std::to_string(balls.size()), std::to_string(treatment.runs)};
        if (balls.empty()) cells.insert(cells.end(), 7, "");
        else {
            cells.push_back(fmt::format("{:.2f}", mean(balls)));
            cells.push_back(fmt::format("{:.2f}", standard_deviation(balls)));
            for (double const fraction : {0.0, 0.25, 0.5, 0.75, 1.0})
                cells.push_back(fmt::format("{}", quantile(balls, fraction)));
        }
        table.row(cells);
    };
    add(plan.source);
    for (std::string const& name : plan.report_order) add(plan.treatment(name));
    return std::move(table).finish();
}

/// The appendix's square: every treatment against every other.
std::string p_value_square(CampaignPlan const& plan, std::vector<Comparison> const& comparisons) {
    std::vector<std::string> shown;
    for (std::string const& name : plan.report_order)
        if (std::any_of(comparisons.begin(), comparisons.end(),
                        [&](Comparison const& c) { return c.a == name || c.b == name; }))
            shown.push_back(name);
    std::string html = "<div class=\"scroll\"><table id=\"p-square\"><thead><tr><th></th>";
    for (std::string const& name : shown)
        html += fmt::format("<th scope=\"col\">{}</th>", escaped(plan.treatment(name).label));
    html += "</tr></thead><tbody>\n";
    for (std::string const& row : shown) {
        html += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(plan.treatment(row).label));
        for (std::string const& column : shown) {
            auto const found = std::find_if(comparisons.begin(), comparisons.end(), [&](Comparison const& c) {
                return (c.a == row && c.b == column) || (c.a == column && c.b == row);
            });
            if (found == comparisons.end()) {
                html += "<td>1</td>";
                continue;
            }
            std::string_view const mark = significance_mark(found->p);
            html +=
                fmt::format("<td{}>{}{}</td>", mark.empty() ? "" : " class=\"significant\"", p_text(found->p), mark);
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string pairs_table(CampaignPlan const& plan, std::vector<Comparison> const& comparisons) {
    HtmlTable table{
        "pairs",
        {{"a", true}, {"b", true}, {"n a"}, {"n b"}, {"U"}, {"p"}, {"p (Holm)"}, {"A12"}, {"95 %"}, {"method", true}}};
    for (Comparison const& c : comparisons)
        table.row({plan.treatment(c.a).label, plan.treatment(c.b).label, std::to_string(c.n_a), std::to_string(c.n_b),
                   fmt::format("{}", c.u), p_text(c.p), p_text(c.p_holm), fmt::format("{:.2f}", c.a12),
                   fmt::format("{:.2f} .. {:.2f}", c.a12_band.low, c.a12_band.high),
                   c.exact ? "exact" : "normal, ties"},
                  {"", "", "", "", "", fmt::format("{}", c.p), fmt::format("{}", c.p_holm), fmt::format("{}", c.a12),
                   fmt::format("{}", c.a12_band.low), ""});
    return std::move(table).finish();
}

std::string populations_table(CampaignPlan const& plan, Results const& results) {
    HtmlTable table{"populations",
                    {{"treatment", true},
                     {"generation"},
                     {"balls"},
                     {"fronts"},
                     {"tied"},
                     {"best shaping"},
                     {"share at best"},
                     {"connections"},
                     {"hidden"}}};
    for (PopulationRow const& p : results.populations) {
        bool const shaped = p.best_shaping >= 0;
        table.row({plan.treatment(p.treatment).label, std::to_string(p.generation), fmt::format("{:.2f}", p.mean_balls),
                   fmt::format("{:.0f}", p.fronts), fmt::format("{:.0f}", p.tied),
                   shaped ? fmt::format("{:.2f}", p.best_shaping) : "",
                   shaped ? fmt::format("{:.2f}", p.shaping_at_max) : "", fmt::format("{:.1f}", p.connections),
                   fmt::format("{:.1f}", p.hidden)});
    }
    return std::move(table).finish();
}

std::string bases_table(CampaignPlan const& plan, Results const& results) {
    HtmlTable table{"knowledge",
                    {{"knowledge base", true},
                     {"made from", true},
                     {"run"},
                     {"seed"},
                     {"balls"},
                     {"individuals"},
                     {"features"},
                     {"values"},
                     {"at top"},
                     {"once"}}};
    for (KnowledgeRow const& base : results.bases) {
        auto const planned = std::find_if(plan.knowledge.begin(), plan.knowledge.end(),
                                          [&](KnowledgePlan const& k) { return k.name == base.knowledge; });
        table.row({planned == plan.knowledge.end() ? base.knowledge : planned->label, base.kind,
                   std::to_string(base.source_run), std::to_string(base.seed), std::to_string(base.balls),
                   std::to_string(base.individuals), std::to_string(base.features),
                   fmt::format("{:.2f} .. {:.2f}", base.least_value, base.greatest_value),
                   std::to_string(base.at_greatest), std::to_string(base.shown_once)});
    }
    return std::move(table).finish();
}

std::string runs_table(CampaignPlan const& plan, Results const& results) {
    HtmlTable table{
        "runs",
        {{"treatment", true}, {"run"}, {"seed"}, {"balls"}, {"generations"}, {"evaluations"}, {"signature", true}}};
    for (RunRow const& run : results.runs)
        table.row({plan.treatment(run.treatment).label, std::to_string(run.run), std::to_string(run.seed),
                   std::to_string(run.balls), run.generations == 0 ? "" : std::to_string(run.generations),
                   run.evaluations == 0 ? "" : std::to_string(run.evaluations), run.signature});
    return std::move(table).finish();
}

/// What the page's script needs of a replay. Events: [step, carrying, door open, lamp lit, balls on the floor,
/// collected], one at each change.
nlohmann::ordered_json replay_data(CampaignPlan const& plan, Results const& results, Replay const& replay) {
    Treatment const& treatment = plan.treatment(replay.step.substr(0, replay.step.find('/')));
    ExperimentConfig const config = read_config(plan.config_path(treatment), treatment.overrides);
    Arena const arena = load_arena(config.arena, config.task);
    nlohmann::ordered_json walls = nlohmann::ordered_json::array(), doors = walls, balls = walls, events = walls;
    auto const rounded = [](double value, double scale) { return std::round(value * scale) / scale; };
    auto const corners = [&](Rect const& r) {
        return nlohmann::ordered_json{rounded(r.x0, 100), rounded(r.x1, 100), rounded(r.y0, 100), rounded(r.y1, 100)};
    };
    for (Rect const& wall : arena.walls) walls.push_back(corners(wall));
    for (Rect const& door : arena.doors) doors.push_back(corners(door));
    for (Point const& ball : arena.task.ball_positions) balls.push_back({rounded(ball.x, 100), rounded(ball.y, 100)});
    std::vector<double> x, y, theta, values;
    nlohmann::ordered_json last;
    for (std::size_t k = 0; k < replay.steps.size(); ++k) {
        ReplayStep const& s = replay.steps[k];
        x.push_back(rounded(s.x, 10));
        y.push_back(rounded(s.y, 10));
        theta.push_back(rounded(s.theta, 100));
        nlohmann::ordered_json const now{static_cast<int>(s.carrying), static_cast<int>(s.door_open),
                                         static_cast<int>(s.switch_on), s.balls_mask, s.collected};
        if (now == last) continue;
        last = now;
        events.push_back(now);
        events.back().insert(events.back().begin(), k);
    }
    if (&replay == &results.replays.front() && !results.panels.empty())
        for (double const value : results.panels.front().values) values.push_back(rounded(value, 1000));
    return {{"arena",
             {{"width", rounded(arena.width, 100)},
              {"height", rounded(arena.height, 100)},
              {"walls", walls},
              {"doors", doors},
              {"balls", balls},
              {"basket",
               {rounded(arena.basket_center.x, 100), rounded(arena.basket_center.y, 100),
                rounded(arena.basket_radius, 100)}},
              {"switch", {rounded(arena.switch_position.x, 100), rounded(arena.switch_position.y, 100)}},
              {"radius", rounded(arena.robot.radius, 100)}}},
            {"x", x},
            {"y", y},
            {"theta", theta},
            {"events", events},
            {"values", values}};
}

std::string replay_section(CampaignPlan const& plan, Results const& results) {
    std::string choices;
    nlohmann::ordered_json data = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < results.replays.size(); ++i) {
        Replay const& replay = results.replays[i];
        if (replay.steps.empty()) continue;
        std::string const treatment = replay.step.substr(0, replay.step.find('/'));
        choices += fmt::format("<option value=\"{}\">{}: best of run {}</option>", data.size(),
                               escaped(plan.treatment(treatment).label),
                               escaped(replay.step.substr(replay.step.find('/') + 1)));
        data.push_back(replay_data(plan, results, replay));
    }
    if (data.empty()) return "";
    return fmt::format(
        R"(<h2 id="replay">Replay</h2>
<div class="replay"><svg id="replay-stage" xmlns="http://www.w3.org/2000/svg" role="img" aria-label="The arena with the robot"></svg>
<div class="controls"><select id="replay-chooser" aria-label="Which run">{}</select><button type="button" id="replay-play">Play</button>
<input type="range" id="replay-slider" min="0" max="0" value="0" aria-label="Step"></div>
<p class="note"><output id="replay-state"></output></p></div>
<p class="note">Red: balls, and the robot while it carries one. Blue lamp: the switch while it is lit. Yellow: where a release scores. Pink: the door.
{}</p>
<script type="application/json" id="replay-data">{}</script>
)",
        choices,
        results.panels.empty()
            ? ""
            : fmt::format("The source run's path is colored by {}'s values: blue high, pale low, gray not found.",
                          escaped(knowledge_label(plan, results.panels.front().knowledge))),
        data.dump());
}

/// One command of each kind, as typed in the campaign's directory beside its configurations.
std::string commands(CampaignPlan plan, Results const& results) {
    plan.directory.clear();
    Choice choice;
    for (KnowledgeRow const& base : results.bases)
        if (base.kind == "lineage")
            choice.chosen.push_back({base.knowledge, 0, base.source_run, base.seed, base.balls});
    bool const known = choice.covers(plan);
    std::string text;
    for (Step const& step : steps_of(plan)) {
        if (step.kind == StepKind::choose || step.run > 1) continue;
        text += shell_text(command_of(plan, CampaignDirectory{""}, Launcher{}, step, known ? &choice : nullptr));
        if (step.kind == StepKind::evolve) {
            Treatment const& treatment = plan.treatment(step.subject);
            if (treatment.runs > 1) text += fmt::format("   # and seeds to {}", seed_of(treatment, treatment.runs));
        }
        text += '\n';
    }
    return text;
}

std::string figure(std::map<std::string, std::string> const& figures, std::string const& name,
                   std::string_view caption) {
    auto const found = figures.find(name);
    if (found == figures.end()) return "";
    // In a page a document's own heading has no place, and ids must not repeat.
    std::string const svg = with_own_ids(found->second.substr(found->second.find("<svg")), fmt::format("{}-", name));
    return fmt::format("<figure id=\"{}\">\n{}<figcaption>{}</figcaption></figure>\n", name, svg, caption);
}

}   // namespace

std::string report_page(CampaignPlan const& plan, Results const& results, std::vector<Comparison> const& comparisons,
                        std::map<std::string, std::string> const& figures) {
    std::size_t planned = static_cast<std::size_t>(plan.source.runs);
    for (Treatment const& target : plan.targets) planned += static_cast<std::size_t>(target.runs);
    int last_generation = 0;
    for (CurveRow const& row : results.curves) last_generation = std::max(last_generation, row.generation);

    std::string page =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
                    "<link rel=\"icon\" href=\"data:,\">\n<style>\n{1}</style></head>\n<body>\n<h1>{0}</h1>\n",
                    escaped(plan.title), report_css);
    page += fmt::format("<p>{} of {} runs finished, up to generation {}.</p>\n", results.runs.size(), planned,
                        last_generation);
    if (results.runs.size() < planned)
        page += "<p class=\"warning\">This campaign is not complete: treatments with fewer runs than planned are "
                "compared with what they have.</p>\n";

    page += "<h2 id=\"performance\">Performance</h2>\n" + treatments_table(plan, results) +
            "<p class=\"note\">Collected balls of the best-of-runs at the last generation: mean, standard deviation (n "
            "- 1), quartiles (interpolated, "
            "type 7).</p>\n";
    page += figure(figures, "figure3",
                   "<b>Figure 3.</b> Number of collected balls of the best-of-run individual along generations, "
                   "averaged over the runs of "
                   "each treatment. Bands: 95 % percentile bootstrap of the mean. The gray dashed line is the source "
                   "task, where other balls count.");
    page += figure(figures, "figure4",
                   "<b>Figure 4.</b> Collected balls of the best-of-run at the last generation; every point is a run. "
                   "Boxes: quartiles and "
                   "median (interpolated); whiskers: last values within 1.5 box heights. Brackets: two-sided "
                   "Mann-Whitney test, * p &lt; 10<sup>-2</sup>, "
                   "** p &lt; 10<sup>-3</sup>, not corrected for the number of comparisons.");
    if (!comparisons.empty()) {
        page += "<h2 id=\"significance\">Statistical significance</h2>\n<p>p-values of two-sided Mann-Whitney tests at "
                "the last generation, "
                "in the order of the paper's appendix; bold with a mark where below 10<sup>-2</sup>.</p>\n" +
                p_value_square(plan, comparisons);
        page += "<p>The same pairs with Holm's correction for all of them, and the effect size A12: the probability "
                "that a run of <i>a</i> collects more "
                "balls than one of <i>b</i> (equal counts half), with its percentile bootstrap interval.</p>\n" +
                pairs_table(plan, comparisons);
    }
    if (!results.bases.empty())
        page +=
            "<h2 id=\"bases\">Knowledge bases</h2>\n" + bases_table(plan, results) +
            "<p class=\"note\">Run, seed and balls: of the source run and its best-of-run. Individuals: whose windows "
            "were read, the length of the lineage where it is one. Features: all, those at the top of the values, and "
            "those that one individual alone has shown.</p>\n";
    std::string const trajectory = results.replays.empty() ? "" : escaped(results.replays.front().step);
    page += figure(
        figures, "figure5",
        fmt::format(
            "<b>Figure 5.</b> Trajectory of the best-of-run of {}, colored by the values of its windows in single "
            "knowledge bases; below each, value by time step (-1: not found).",
            trajectory));
    page += figure(figures, "figure6",
                   "<b>Figure 6.</b> The same trajectory colored by the product of the values in several knowledge "
                   "bases (0: not found in one "
                   "of them).");
    page += replay_section(plan, results);
    if (!results.populations.empty())
        page +=
            "<h2 id=\"population\">Populations</h2>\n" + populations_table(plan, results) +
            "<p class=\"note\">Means over the runs: balls of the survivors; fronts of parents and children together; "
            "survivors that share all objectives with another; the best value of the shaping objective, and the "
            "share of the survivors that have it; connections and hidden neurons of their networks.</p>\n";
    page += "<h2 id=\"all-runs\">All runs</h2>\n" + runs_table(plan, results);

    std::set<std::string> versions;
    for (RunRow const& run : results.runs)
        if (!run.version.empty()) versions.insert(run.version);
    BuildInformation const build = build_information();
    page += fmt::format(
        "<h2 id=\"origin\">How this was made</h2>\n<p>Runs: Lore {}. Report: Lore {} ({}), {}.</p>\n<pre>{}</pre>\n",
        versions.empty() ? "of unknown version" : escaped(fmt::format("{}", fmt::join(versions, ", "))),
        escaped(build.version), escaped(build.commit), escaped(build.compiler), escaped(commands(plan, results)));
    page += fmt::format("<script>\n{}</script>\n</body></html>\n", report_js);
    return page;
}

}   // namespace lore
