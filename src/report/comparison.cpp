#include "comparison.h"

#include "csv_columns.h"

#include <lore/statistics/holm.h>
#include <lore/statistics/mann_whitney.h>

#include <algorithm>

#include <fmt/format.h>

namespace lore {

namespace {

Comparison compared(std::string const& a, std::string const& b, std::vector<double> const& first,
                    std::vector<double> const& second) {
    MannWhitney const test = mann_whitney(first, second);
    return {a,      b,      static_cast<int>(first.size()),    static_cast<int>(second.size()), test.u,
            test.p, test.p, vargha_delaney_a12(first, second), bootstrap_a12(first, second),    test.exact};
}

std::vector<CsvColumn<Comparison>> comparison_columns() {
    return {csv_column("a", &Comparison::a),           csv_column("b", &Comparison::b),
            csv_column("n_a", &Comparison::n_a),       csv_column("n_b", &Comparison::n_b),
            csv_column("u", &Comparison::u),           csv_column("p", &Comparison::p),
            csv_column("p_holm", &Comparison::p_holm), csv_column("a12", &Comparison::a12)};
}

/// Of all of these together.
void correct(std::vector<Comparison>& comparisons) {
    std::vector<double> p_values;
    for (Comparison const& comparison : comparisons) p_values.push_back(comparison.p);
    std::vector<double> const adjusted = holm_adjusted(p_values);
    for (std::size_t k = 0; k < comparisons.size(); ++k) comparisons[k].p_holm = adjusted[k];
}

}   // namespace

std::vector<Comparison> compare_treatments(CampaignPlan const& plan, Results const& results) {
    std::vector<Comparison> comparisons;
    for (std::size_t i = 0; i < plan.report_order.size(); ++i) {
        for (std::size_t j = i + 1; j < plan.report_order.size(); ++j) {
            std::string const &a = plan.report_order[i], &b = plan.report_order[j];
            if (plan.treatment(a).target != plan.treatment(b).target || results.unit_of(a) != results.unit_of(b))
                continue;
            auto const first = results.final_rewards(a), second = results.final_rewards(b);
            if (!first.empty() && !second.empty()) comparisons.push_back(compared(a, b, first, second));
        }
    }
    correct(comparisons);
    return comparisons;
}

std::vector<double> rewards_of(CampaignPlan const& plan, Results const& results, std::string_view name) {
    PoolPlan const* const pool = plan.pool(name);
    if (pool == nullptr) return results.final_rewards(name);
    std::vector<double> rewards;
    for (RunRow const& run : results.runs)
        if (std::find(pool->treatments.begin(), pool->treatments.end(), run.treatment) != pool->treatments.end())
            rewards.push_back(run.reward);
    return rewards;
}

std::vector<Comparison> compare_pools(CampaignPlan const& plan, Results const& results) {
    std::vector<Comparison> comparisons;
    for (PoolPlan const& pool : plan.pools)
        for (std::string const& other : pool.against) {
            auto const first = rewards_of(plan, results, pool.name), second = rewards_of(plan, results, other);
            if (!first.empty() && !second.empty()) comparisons.push_back(compared(pool.name, other, first, second));
        }
    correct(comparisons);
    return comparisons;
}

std::string comparisons_csv(std::vector<Comparison> const& comparisons) {
    return csv_text(comparison_columns(), comparisons);
}

std::string pools_csv(std::vector<Comparison> const& comparisons) {
    std::vector<CsvColumn<Comparison>> columns = comparison_columns();
    columns.push_back(csv_column_within(&Comparison::a12_band, csv_column("a12_low", &Interval::low)));
    columns.push_back(csv_column_within(&Comparison::a12_band, csv_column("a12_high", &Interval::high)));
    return csv_text(columns, comparisons);
}

std::string_view significance_mark(double p) { return p < 1e-3 ? "**" : p < 1e-2 ? "*" : ""; }
std::string p_text(double p) { return p < 1e-3 ? fmt::format("{:.1e}", p) : fmt::format("{:.3f}", p); }

}   // namespace lore
