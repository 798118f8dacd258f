#include "html.h"
#include "page_parts.h"
#include "panels.h"

#include <lore/statistics/quantiles.h>

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

std::string two_decimals(double value) { return fmt::format("{:.2f}", value); }
std::string count(std::uint64_t value) { return value == 0 ? "" : std::to_string(value); }

/// A number of a treatment's runs at their end; "" without runs.
template <class Function>
HtmlCell if_any(std::vector<double> const& rewards, Function const& text) {
    return rewards.empty() ? HtmlCell{""} : HtmlCell{text(rewards)};
}

/// A mean of rewards: of counts with two decimals.
std::function<std::string(double)> mean_text(Results const& results) {
    if (results.are_counts()) return two_decimals;
    return [](double value) { return reward_text(value); };
}

/// Columns for rows with `rewards`, those of runs at their end.
template <class Row>
void add_statistics(std::vector<HtmlColumn<Row>>& columns, Results const& results) {
    auto const shown = mean_text(results);
    columns.push_back(
        {"mean", [=](Row const& r) { return if_any(r.rewards, [&](auto const& all) { return shown(mean(all)); }); }});
    columns.push_back({"sd", [=](Row const& r) {
                           return r.rewards.size() < 2 ? HtmlCell{""} : HtmlCell{shown(standard_deviation(r.rewards))};
                       }});
    std::vector<std::pair<std::string, double>> const quantiles{
        {"least", 0.0}, {"Q1", 0.25}, {"median", 0.5}, {"Q3", 0.75}, {"most", 1.0}};
    for (auto const& [heading, fraction] : quantiles)
        columns.push_back({heading, [counts = results.are_counts(), at = fraction](Row const& r) {
                               return if_any(r.rewards, [&](auto const& all) {
                                   double const value = quantile(all, at);
                                   return counts ? fmt::format("{}", value) : reward_text(value);
                               });
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
        std::vector<double> rewards;
    };
    std::vector<Row> rows;
    for (std::string const& name : all_treatments(plan))
        rows.push_back({&plan.treatment(name), results.final_rewards(name)});

    std::vector<HtmlColumn<Row>> columns{{"treatment", [](Row const& r) { return r.treatment->label; }, true},
                                         {"runs", [](Row const& r) { return std::to_string(r.rewards.size()); }},
                                         {"planned", [](Row const& r) { return std::to_string(r.treatment->runs); }}};
    if (results.has_several_units(plan))
        columns.push_back(
            {"unit", [&](Row const& r) { return results.unit_of(r.treatment->name).value_or(""); }, true});
    add_statistics(columns, results);
    return html_table("treatments", columns, rows);
}

std::string matrix_table(CampaignPlan const& plan, std::vector<MatrixField> const& fields) {
    using Row = MatrixField;
    using Text = std::function<HtmlCell(Row const&)>;
    auto const if_any = [](Text const& text) {
        return [=](Row const& f) { return f.why.empty() ? text(f) : HtmlCell{""}; };
    };
    std::vector<HtmlColumn<Row>> const columns{
        {"knowledge of", [&](Row const& f) { return plan.treatment(f.pair.source).label; }, true},
        {"runs on", [&](Row const& f) { return plan.task(f.pair.target).label; }, true},
        {"with", if_any([](Row const& f) {
             return HtmlCell{reward_text(f.mean), fmt::format("{}", f.mean), fmt::format("n = {}", f.n)};
         })},
        {"without", if_any([](Row const& f) {
             return HtmlCell{reward_text(f.mean_none), fmt::format("{}", f.mean_none), fmt::format("n = {}", f.n_none)};
         })},
        {"difference", if_any([](Row const& f) {
             return HtmlCell{difference_text(f), fmt::format("{}", f.difference), difference_band_text(f)};
         })},
        {"unit", if_any([](Row const& f) { return f.unit; }), true},
        {"A12", if_any([](Row const& f) {
             return HtmlCell{two_decimals(f.a12), fmt::format("{}", f.a12),
                             fmt::format("{:.2f} .. {:.2f}", f.a12_band.low, f.a12_band.high)};
         })},
        {"p", if_any([](Row const& f) {
             return HtmlCell{p_text(f.p), fmt::format("{}", f.p)};
         })},
        {"p (Holm)", if_any([](Row const& f) {
             return HtmlCell{p_text(f.p_holm), fmt::format("{}", f.p_holm)};
         })},
        {"not run", [](Row const& f) { return f.why; }, true}};
    return html_table("matrix-table", columns, fields, Spacing::dense);
}

std::string pools_table(CampaignPlan const& plan, Results const& results) {
    struct Row {
        PoolPlan const* pool;
        std::vector<double> rewards;
    };
    std::vector<Row> rows;
    for (PoolPlan const& pool : plan.pools) rows.push_back({&pool, rewards_of(plan, results, pool.name)});

    std::vector<HtmlColumn<Row>> columns{
        {"pool", [](Row const& r) { return r.pool->label; }, true},
        {"treatments", [&](Row const& r) { return labels_of(plan, r.pool->treatments); }, true},
        {"runs", [](Row const& r) { return std::to_string(r.rewards.size()); }}};
    add_statistics(columns, results);
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
                html += row == column ? "<td>1</td>" : "<td>-</td>";
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
    auto const shown = mean_text(results);
    auto const if_shaped = [&](Row const& p, double value) {
        return !plan.treatment(p.treatment).knowledge.empty() ? shown(value) : std::string{};
    };
    std::vector<HtmlColumn<Row>> const columns{
        {"treatment", [&](Row const& p) { return plan.treatment(p.treatment).label; }, true},
        {"generation", [](Row const& p) { return std::to_string(p.generation); }},
        {std::string{results.reward_word()}, [&](Row const& p) { return shown(p.mean_reward); }},
        {"fronts", [](Row const& p) { return fmt::format("{:.0f}", p.fronts); }},
        {"tied", [](Row const& p) { return fmt::format("{:.0f}", p.tied); }},
        {"best shaping", [&](Row const& p) { return if_shaped(p, p.best_shaping); }},
        {"share at best",
         [&](Row const& p) {
             return plan.treatment(p.treatment).knowledge.empty() ? std::string{} : two_decimals(p.shaping_at_max);
         }},
        {"connections", [](Row const& p) { return fmt::format("{:.1f}", p.connections); }},
        {"hidden", [](Row const& p) { return fmt::format("{:.1f}", p.hidden); }}};
    return html_table("populations", columns, results.populations);
}

std::string speeds_table(CampaignPlan const& plan, Results const& results, std::string_view id) {
    using Row = SpeedRow;
    auto const area_text = [counts = results.are_counts()](double value) {
        return counts ? fmt::format("{:.0f}", value) : reward_text(value);
    };
    // Intervals stand below their means: in columns of their own they make the table wider than the page.
    auto const with_interval = [](double value, double low, double high, auto const& text) {
        return HtmlCell{text(value), fmt::format("{}", value), fmt::format("{} .. {}", text(low), text(high))};
    };
    std::vector<HtmlColumn<Row>> columns{
        {"treatment", [&](Row const& s) { return plan.treatment(s.treatment).label; }, true},
        {"runs", [](Row const& s) { return std::to_string(s.runs); }}};
    auto const whole = [](double value) { return fmt::format("{:.0f}", value); };
    std::size_t const levels = results.speeds.empty() ? 0 : results.speeds.front().to.size();
    for (std::size_t k = 0; k < levels; ++k) {
        columns.push_back({fmt::format("to {}", reward_text(results.speeds.front().to[k].level)), [=](Row const& s) {
                               return with_interval(s.to[k].mean, s.to[k].low, s.to[k].high, whole);
                           }});
        columns.push_back({"median", [=](Row const& s) { return whole(s.to[k].median); }});
        columns.push_back({"there", [=](Row const& s) { return std::to_string(s.to[k].reached); }});
    }
    columns.push_back(
        {"area", [=](Row const& s) { return with_interval(s.area, s.area_low, s.area_high, area_text); }});
    return html_table(id, columns, results.speeds, Spacing::dense);
}

std::string leads_table(CampaignPlan const& plan, Results const& results) {
    using Row = LeadRow;
    auto const shown = mean_text(results);
    auto const label = [&](std::string const& name) { return plan.treatment(name).label; };
    std::vector<HtmlColumn<Row>> const columns{
        {"treatment", [&](Row const& l) { return label(l.treatment); }, true},
        {"policy", [&](Row const& l) { return label(l.policy); }, true},
        {"no transfer", [&](Row const& l) { return label(l.none); }, true},
        {"generation", [](Row const& l) { return std::to_string(l.generation); }},
        {std::string{results.reward_word()}, [&](Row const& l) { return shown(l.reward); }},
        {"of the policy", [&](Row const& l) { return shown(l.policy_reward); }},
        {"of no transfer", [&](Row const& l) { return shown(l.none_reward); }},
        {"share of the lead", [](Row const& l) { return two_decimals(l.share); }}};
    return html_table("leads", columns, results.leads);
}

std::string bases_table(CampaignPlan const& plan, Results const& results) {
    using Row = KnowledgeRow;
    auto const shown = mean_text(results);
    std::vector<HtmlColumn<Row>> const columns{
        {"knowledge base", [&](Row const& b) { return knowledge_label(plan, b.knowledge); }, true},
        {"made from", [](Row const& b) { return b.kind; }, true},
        {"run", [](Row const& b) { return std::to_string(b.source_run); }},
        {"seed", [](Row const& b) { return std::to_string(b.seed); }},
        {std::string{results.reward_word()}, [](Row const& b) { return reward_text(b.reward); }},
        {"individuals", [](Row const& b) { return std::to_string(b.individuals); }},
        {"features", [](Row const& b) { return std::to_string(b.features); }},
        {"values",
         [&](Row const& b) { return fmt::format("{} .. {}", shown(b.least_value), shown(b.greatest_value)); }},
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
        {std::string{results.reward_word()}, [](Row const& r) { return reward_text(r.reward); }},
        {"generations", [](Row const& r) { return count(static_cast<std::uint64_t>(r.generations)); }},
        {"evaluations", [](Row const& r) { return count(r.evaluations); }},
        {"signature", [](Row const& r) { return r.signature; }, true}};
    return html_table("runs", columns, results.runs);
}

}   // namespace lore
