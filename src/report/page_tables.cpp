#include "html.h"
#include "page_parts.h"

#include <lore/statistics/quantiles.h>

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

std::string two_decimals(double value) { return fmt::format("{:.2f}", value); }
std::string count(std::uint64_t value) { return value == 0 ? "" : std::to_string(value); }

/// A number of a treatment's runs at their end; "" without runs.
template <class Function>
HtmlCell if_any(std::vector<double> const& balls, Function const& text) {
    return balls.empty() ? HtmlCell{""} : HtmlCell{text(balls)};
}

/// Columns for rows with `balls`, those of runs at their end.
template <class Row>
void add_statistics(std::vector<HtmlColumn<Row>>& columns) {
    columns.push_back(
        {"mean", [](Row const& r) { return if_any(r.balls, [](auto const& b) { return two_decimals(mean(b)); }); }});
    columns.push_back({"sd", [](Row const& r) {
                           return if_any(r.balls, [](auto const& b) { return two_decimals(standard_deviation(b)); });
                       }});
    std::vector<std::pair<std::string, double>> const quantiles{
        {"least", 0.0}, {"Q1", 0.25}, {"median", 0.5}, {"Q3", 0.75}, {"most", 1.0}};
    for (auto const& [heading, fraction] : quantiles)
        columns.push_back({heading, [at = fraction](Row const& r) {
                               return if_any(r.balls,
                                             [&](auto const& b) { return fmt::format("{}", quantile(b, at)); });
                           }});
}

std::string labels_of(CampaignPlan const& plan, std::vector<std::string> const& treatments) {
    std::vector<std::string> labels;
    for (std::string const& name : treatments) labels.push_back(plan.treatment(name).label);
    return fmt::format("{}", fmt::join(labels, ", "));
}

}   // namespace

std::string treatments_table(CampaignPlan const& plan, Results const& results) {
    struct Row {
        Treatment const* treatment;
        std::vector<double> balls;
    };
    std::vector<Row> rows{{&plan.source, results.final_balls(plan.source.name)}};
    for (std::string const& name : plan.report_order)
        rows.push_back({&plan.treatment(name), results.final_balls(name)});

    std::vector<HtmlColumn<Row>> columns{{"treatment", [](Row const& r) { return r.treatment->label; }, true},
                                         {"runs", [](Row const& r) { return std::to_string(r.balls.size()); }},
                                         {"planned", [](Row const& r) { return std::to_string(r.treatment->runs); }}};
    add_statistics(columns);
    return html_table("treatments", columns, rows);
}

std::string pools_table(CampaignPlan const& plan, Results const& results) {
    struct Row {
        PoolPlan const* pool;
        std::vector<double> balls;
    };
    std::vector<Row> rows;
    for (PoolPlan const& pool : plan.pools) rows.push_back({&pool, balls_of(plan, results, pool.name)});

    std::vector<HtmlColumn<Row>> columns{
        {"pool", [](Row const& r) { return r.pool->label; }, true},
        {"treatments", [&](Row const& r) { return labels_of(plan, r.pool->treatments); }, true},
        {"runs", [](Row const& r) { return std::to_string(r.balls.size()); }}};
    add_statistics(columns);
    return html_table("pools", columns, rows, Spacing::dense);
}

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

std::string pairs_table(CampaignPlan const& plan, std::vector<Comparison> const& comparisons, std::string_view id,
                        Spacing spacing) {
    using Row = Comparison;
    auto const number = [](double value) { return fmt::format("{}", value); };
    std::vector<HtmlColumn<Row>> const columns{
        {"a", [&](Row const& c) { return plan.label(c.a); }, true},
        {"b", [&](Row const& c) { return plan.label(c.b); }, true},
        {"n a", [](Row const& c) { return std::to_string(c.n_a); }},
        {"n b", [](Row const& c) { return std::to_string(c.n_b); }},
        {"U", [&](Row const& c) { return number(c.u); }},
        {"p",
         [&](Row const& c) {
             return HtmlCell{p_text(c.p), number(c.p)};
         }},
        {"p (Holm)",
         [&](Row const& c) {
             return HtmlCell{p_text(c.p_holm), number(c.p_holm)};
         }},
        {"A12",
         [&](Row const& c) {
             return HtmlCell{two_decimals(c.a12), number(c.a12)};
         }},
        {"95 %",
         [&](Row const& c) {
             return HtmlCell{fmt::format("{:.2f} .. {:.2f}", c.a12_band.low, c.a12_band.high), number(c.a12_band.low)};
         }},
        {"method", [](Row const& c) { return c.exact ? "exact" : "normal, ties"; }, true}};
    return html_table(id, columns, comparisons, spacing);
}

std::string populations_table(CampaignPlan const& plan, Results const& results) {
    using Row = PopulationRow;
    auto const if_shaped = [&](Row const& p, double value) {
        return !plan.treatment(p.treatment).knowledge.empty() ? two_decimals(value) : std::string{};
    };
    std::vector<HtmlColumn<Row>> const columns{
        {"treatment", [&](Row const& p) { return plan.treatment(p.treatment).label; }, true},
        {"generation", [](Row const& p) { return std::to_string(p.generation); }},
        {"balls", [](Row const& p) { return two_decimals(p.mean_balls); }},
        {"fronts", [](Row const& p) { return fmt::format("{:.0f}", p.fronts); }},
        {"tied", [](Row const& p) { return fmt::format("{:.0f}", p.tied); }},
        {"best shaping", [&](Row const& p) { return if_shaped(p, p.best_shaping); }},
        {"share at best", [&](Row const& p) { return if_shaped(p, p.shaping_at_max); }},
        {"connections", [](Row const& p) { return fmt::format("{:.1f}", p.connections); }},
        {"hidden", [](Row const& p) { return fmt::format("{:.1f}", p.hidden); }}};
    return html_table("populations", columns, results.populations);
}

std::string speeds_table(CampaignPlan const& plan, Results const& results) {
    using Row = SpeedRow;
    // Intervals stand below their means: in columns of their own they make the table wider than the page.
    auto const with_interval = [](double value, double low, double high) {
        return HtmlCell{fmt::format("{:.0f}", value), fmt::format("{}", value),
                        fmt::format("{:.0f} .. {:.0f}", low, high)};
    };
    std::vector<HtmlColumn<Row>> columns{
        {"treatment", [&](Row const& s) { return plan.treatment(s.treatment).label; }, true},
        {"runs", [](Row const& s) { return std::to_string(s.runs); }}};
    for (std::size_t k = 0; k < timed_balls.size(); ++k) {
        columns.push_back({fmt::format("to {}", timed_balls[k]),
                           [=](Row const& s) { return with_interval(s.to[k].mean, s.to[k].low, s.to[k].high); }});
        columns.push_back({"median", [=](Row const& s) { return fmt::format("{:.0f}", s.to[k].median); }});
        columns.push_back({"there", [=](Row const& s) { return std::to_string(s.to[k].reached); }});
    }
    columns.push_back({"area", [=](Row const& s) { return with_interval(s.area, s.area_low, s.area_high); }});
    return html_table("speeds", columns, results.speeds, Spacing::dense);
}

std::string leads_table(CampaignPlan const& plan, Results const& results) {
    using Row = LeadRow;
    auto const label = [&](std::string const& name) { return plan.treatment(name).label; };
    std::vector<HtmlColumn<Row>> const columns{
        {"treatment", [&](Row const& l) { return label(l.treatment); }, true},
        {"policy", [&](Row const& l) { return label(l.policy); }, true},
        {"no transfer", [&](Row const& l) { return label(l.none); }, true},
        {"generation", [](Row const& l) { return std::to_string(l.generation); }},
        {"balls", [](Row const& l) { return two_decimals(l.balls); }},
        {"of the policy", [](Row const& l) { return two_decimals(l.policy_balls); }},
        {"of no transfer", [](Row const& l) { return two_decimals(l.none_balls); }},
        {"share of the lead", [](Row const& l) { return two_decimals(l.share); }}};
    return html_table("leads", columns, results.leads);
}

std::string bases_table(CampaignPlan const& plan, Results const& results) {
    using Row = KnowledgeRow;
    auto const label = [&](Row const& base) {
        auto const planned = std::find_if(plan.knowledge.begin(), plan.knowledge.end(),
                                          [&](KnowledgePlan const& k) { return k.name == base.knowledge; });
        return planned == plan.knowledge.end() ? base.knowledge : planned->label;
    };
    std::vector<HtmlColumn<Row>> const columns{
        {"knowledge base", label, true},
        {"made from", [](Row const& b) { return b.kind; }, true},
        {"run", [](Row const& b) { return std::to_string(b.source_run); }},
        {"seed", [](Row const& b) { return std::to_string(b.seed); }},
        {"balls", [](Row const& b) { return std::to_string(b.balls); }},
        {"individuals", [](Row const& b) { return std::to_string(b.individuals); }},
        {"features", [](Row const& b) { return std::to_string(b.features); }},
        {"values", [](Row const& b) { return fmt::format("{:.2f} .. {:.2f}", b.least_value, b.greatest_value); }},
        {"at top", [](Row const& b) { return std::to_string(b.at_greatest); }},
        {"once", [](Row const& b) { return std::to_string(b.shown_once); }}};
    return html_table("knowledge", columns, results.bases);
}

std::string runs_table(CampaignPlan const& plan, Results const& results) {
    using Row = RunRow;
    std::vector<HtmlColumn<Row>> const columns{
        {"treatment", [&](Row const& r) { return plan.treatment(r.treatment).label; }, true},
        {"run", [](Row const& r) { return std::to_string(r.run); }},
        {"seed", [](Row const& r) { return std::to_string(r.seed); }},
        {"balls", [](Row const& r) { return std::to_string(r.balls); }},
        {"generations", [](Row const& r) { return count(static_cast<std::uint64_t>(r.generations)); }},
        {"evaluations", [](Row const& r) { return count(r.evaluations); }},
        {"signature", [](Row const& r) { return r.signature; }, true}};
    return html_table("runs", columns, results.runs);
}

}   // namespace lore
