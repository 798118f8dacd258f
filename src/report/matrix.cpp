#include "matrix.h"

#include "csv_columns.h"

#include <lore/statistics/holm.h>
#include <lore/statistics/mann_whitney.h>
#include <lore/statistics/quantiles.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lore {

namespace {

/// At which a treatment's runs have their final rewards.
int generation_of(Results const& results, std::string_view treatment) {
    int last = 0;
    for (RunRow const& run : results.runs)
        if (run.treatment == treatment) last = std::max(last, run.generations);
    return last > 0 ? last : results.last_generation(treatment);   // final.csv alone does not say it
}

MatrixField field_of(TransferPair const& pair, Results const& results) {
    MatrixField field;
    field.pair = pair;
    if (!pair.misfit.empty()) {
        field.why = misfit_word;
        return field;
    }
    auto const helped = results.final_rewards(pair.treatment), none = results.final_rewards(pair.none);
    if (helped.empty() || none.empty()) {
        field.why = "no runs yet";
        return field;
    }
    field.unit = results.unit_of(pair.none).value_or("");
    field.generation = generation_of(results, pair.none);
    field.n = static_cast<int>(helped.size());
    field.n_none = static_cast<int>(none.size());
    field.mean = mean(helped);
    field.mean_none = mean(none);
    field.difference = field.mean - field.mean_none;
    field.difference_band = bootstrap_mean_difference(helped, none);
    field.a12 = vargha_delaney_a12(helped, none);
    field.a12_band = bootstrap_a12(helped, none);
    field.p = field.p_holm = mann_whitney(helped, none).p;
    return field;
}

/// All three numbers of a difference have as many decimals as show three digits of the largest.
std::string signed_text(MatrixField const& field, double value) {
    double const largest = std::max(
        {std::abs(field.difference), std::abs(field.difference_band.low), std::abs(field.difference_band.high)});
    int const decimals = largest > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(largest))), 0, 9) : 0;
    return value == 0 ? "0" : fmt::format("{:+.{}f}", value, decimals);
}

using Column = CsvColumn<MatrixField>;

Column of_pair(std::string name, std::string TransferPair::*member) {
    return csv_column_within(&MatrixField::pair, csv_column(std::move(name), member));
}

/// Empty in a field without numbers.
Column if_known(Column column) {
    column.write = [write = std::move(column.write)](std::string& text, MatrixField const& field) {
        if (field.why.empty()) write(text, field);
    };
    return column;
}

std::vector<Column> matrix_columns() {
    std::vector<Column> columns{of_pair("source", &TransferPair::source), of_pair("target", &TransferPair::target),
                                of_pair("treatment", &TransferPair::treatment), of_pair("none", &TransferPair::none)};
    auto const add = [&](std::string name, auto member) {
        columns.push_back(if_known(csv_column(std::move(name), member)));
    };
    auto const add_band = [&](std::string const& name, Interval MatrixField::*band) {
        columns.push_back(if_known(csv_column_within(band, csv_column(name + "_low", &Interval::low))));
        columns.push_back(if_known(csv_column_within(band, csv_column(name + "_high", &Interval::high))));
    };
    add("unit", &MatrixField::unit);
    add("generation", &MatrixField::generation);
    add("n", &MatrixField::n);
    add("n_none", &MatrixField::n_none);
    add("mean", &MatrixField::mean);
    add("mean_none", &MatrixField::mean_none);
    add("difference", &MatrixField::difference);
    add_band("difference", &MatrixField::difference_band);
    add("a12", &MatrixField::a12);
    add_band("a12", &MatrixField::a12_band);
    add("p", &MatrixField::p);
    add("p_holm", &MatrixField::p_holm);
    columns.push_back(csv_column("why", &MatrixField::why));
    return columns;
}

}   // namespace

std::vector<MatrixField> transfer_matrix(CampaignPlan const& plan, Results const& results) {
    std::vector<MatrixField> fields;
    std::vector<double> p_values;
    for (TransferPair const& pair : plan.transfer) {
        fields.push_back(field_of(pair, results));
        if (fields.back().why.empty()) p_values.push_back(fields.back().p);
    }
    std::vector<double> const adjusted = holm_adjusted(p_values);
    auto next = adjusted.begin();
    for (MatrixField& field : fields)
        if (field.why.empty()) field.p_holm = *next++;
    return fields;
}

std::string matrix_csv(std::vector<MatrixField> const& fields) { return csv_text(matrix_columns(), fields); }

CampaignPlan without_misfits(CampaignPlan plan, Results const& results) {
    for (TransferPair& pair : plan.transfer) {
        bool const known = std::any_of(results.misfits.begin(), results.misfits.end(), [&](FieldName const& field) {
            return field.source == pair.source && field.target == pair.target;
        });
        if (!known || pair.treatment.empty() || !results.final_rewards(pair.treatment).empty()) continue;
        std::erase(plan.report_order, pair.treatment);
        std::erase_if(plan.targets, [&](Treatment const& treatment) { return treatment.name == pair.treatment; });
        pair.treatment.clear();
        pair.misfit = misfit_word;
    }
    return plan;
}

std::string difference_text(MatrixField const& field) { return signed_text(field, field.difference); }

std::string difference_band_text(MatrixField const& field) {
    return fmt::format("{} .. {}", signed_text(field, field.difference_band.low),
                       signed_text(field, field.difference_band.high));
}

std::string count_text(std::vector<MatrixField> const& fields, int MatrixField::*member) {
    int least = 0, most = 0;
    for (MatrixField const& field : fields) {
        if (!field.why.empty()) continue;
        least = most == 0 ? field.*member : std::min(least, field.*member);
        most = std::max(most, field.*member);
    }
    return least == most ? std::to_string(most) : fmt::format("{} to {}", least, most);
}

}   // namespace lore
