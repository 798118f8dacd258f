#include "results.h"

#include "csv_columns.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/file.h>

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace lore {

namespace {

// A new column is one line here, and a member of the row.
// `word` is what the reward is called: the unit that the first worlds have stands in the columns' names. Of other
// rewards the unit has a column of its own, and means all their digits, since they may be small.

template <class Row>
using Columns = std::vector<CsvColumn<Row>>;

bool is_first(std::string_view word) { return word == first_reward_unit; }
Digits digits_of(std::string_view word) { return is_first(word) ? rounded : Digits::shortest; }
std::string named(std::string_view before, std::string_view word) { return fmt::format("{}{}", before, word); }

Columns<RunRow> final_columns(std::string_view word) {
    Columns<RunRow> columns{csv_column("treatment", &RunRow::treatment), csv_column("run", &RunRow::run),
                            csv_column("seed", &RunRow::seed), csv_column(named("", word), &RunRow::reward)};
    if (!is_first(word)) columns.push_back(csv_column("unit", &RunRow::reward_unit));
    return columns;
}

Columns<RunRow> run_columns(std::string_view word) {
    Columns<RunRow> columns = final_columns(word);
    auto const add = [&](CsvColumn<RunRow> column) { columns.push_back(std::move(column)); };
    add(csv_column("generations", &RunRow::generations));
    add(csv_column("evaluations", &RunRow::evaluations));
    add(csv_column("signature", &RunRow::signature));
    add(csv_column("version", &RunRow::version));
    return columns;
}

Columns<CurveRow> curve_columns(std::string_view word) {
    Digits const digits = digits_of(word);
    return {csv_column("treatment", &CurveRow::treatment), csv_column("generation", &CurveRow::generation),
            csv_column("runs", &CurveRow::runs),           csv_column("mean", &CurveRow::mean, digits),
            csv_column("low", &CurveRow::low, digits),     csv_column("high", &CurveRow::high, digits)};
}

Columns<PopulationRow> population_columns(std::string_view word) {
    Digits const digits = digits_of(word);
    return {csv_column("treatment", &PopulationRow::treatment),
            csv_column("generation", &PopulationRow::generation),
            csv_column("runs", &PopulationRow::runs),
            csv_column(named("mean_", word), &PopulationRow::mean_reward, digits),
            csv_column("fronts", &PopulationRow::fronts, rounded),
            csv_column("tied", &PopulationRow::tied, rounded),
            csv_column("best_shaping", &PopulationRow::best_shaping, digits),
            csv_column("shaping_at_max", &PopulationRow::shaping_at_max, rounded),
            csv_column("connections", &PopulationRow::connections, rounded),
            csv_column("hidden", &PopulationRow::hidden, rounded)};
}

Columns<KnowledgeRow> knowledge_columns(std::string_view word) {
    return {csv_column("knowledge", &KnowledgeRow::knowledge),
            csv_column("kind", &KnowledgeRow::kind),
            csv_column("source_run", &KnowledgeRow::source_run),
            csv_column("seed", &KnowledgeRow::seed),
            csv_column(named("", word), &KnowledgeRow::reward),
            csv_column("individuals", &KnowledgeRow::individuals),
            csv_column("windows", &KnowledgeRow::windows),
            csv_column("features", &KnowledgeRow::features),
            csv_column("least_value", &KnowledgeRow::least_value),
            csv_column("greatest_value", &KnowledgeRow::greatest_value),
            csv_column("at_greatest", &KnowledgeRow::at_greatest),
            csv_column("shown_once", &KnowledgeRow::shown_once)};
}

/// A number of the time to the which-th level.
template <class Value>
CsvColumn<SpeedRow> time_column(std::string name, std::size_t which, Value TimeToLevel::*member,
                                Digits digits = rounded) {
    CsvColumn<TimeToLevel> const column = csv_column(name, member, digits);
    return {std::move(name), [=](std::string& text, SpeedRow const& row) { column.write(text, row.to[which]); },
            [=](CsvTable const& table, std::size_t r, std::size_t c, SpeedRow& row) {
                if (row.to.size() <= which) row.to.resize(which + 1);
                column.read(table, r, c, row.to[which]);
            }};
}

/// `first_levels`: 1, 3 and 5, which stand in the columns' names; other levels have a column of their own, and the
/// names have their number.
Columns<SpeedRow> speed_columns(std::string_view word, std::size_t levels, bool first_levels) {
    Columns<SpeedRow> columns{csv_column("treatment", &SpeedRow::treatment), csv_column("runs", &SpeedRow::runs),
                              csv_column("generations", &SpeedRow::generations)};
    for (std::size_t k = 0; k < levels; ++k) {
        std::string const name = fmt::format("{}", first_levels ? first_reward_levels[k] : static_cast<double>(k + 1));
        auto const add = [&](std::string_view form, auto member, Digits digits = rounded) {
            columns.push_back(time_column(fmt::format(fmt::runtime(form), name), k, member, digits));
        };
        if (!first_levels) add("level_{}", &TimeToLevel::level, Digits::shortest);
        add("reached_{}", &TimeToLevel::reached);
        add("time_{}", &TimeToLevel::mean);
        add("time_{}_low", &TimeToLevel::low);
        add("time_{}_high", &TimeToLevel::high);
        add("median_{}", &TimeToLevel::median);
    }
    Digits const digits = digits_of(word);
    columns.push_back(csv_column("area", &SpeedRow::area, digits));
    columns.push_back(csv_column("area_low", &SpeedRow::area_low, digits));
    columns.push_back(csv_column("area_high", &SpeedRow::area_high, digits));
    return columns;
}

Columns<LeadRow> lead_columns(std::string_view word) {
    Digits const digits = digits_of(word);
    return {csv_column("treatment", &LeadRow::treatment),
            csv_column("policy", &LeadRow::policy),
            csv_column("none", &LeadRow::none),
            csv_column("generation", &LeadRow::generation),
            csv_column(named("", word), &LeadRow::reward, digits),
            csv_column(named("policy_", word), &LeadRow::policy_reward, digits),
            csv_column(named("none_", word), &LeadRow::none_reward, digits),
            csv_column("share", &LeadRow::share, rounded)};
}

template <class Row>
void write(CampaignDirectory const& directory, std::string_view name, std::vector<CsvColumn<Row>> const& columns,
           std::vector<Row> const& rows) {
    write_file_atomically(directory.file(name), std::string_view{csv_text(columns, rows)});
}

/// One of the tables, if it is there.
class Table {
public:
    Table(CampaignDirectory const& directory, std::string_view name) {
        std::string const path = directory.file(name);
        if (is_there(path)) table_.emplace(CsvTable::read(path, "Make it again from the runs."));
    }
    bool has(std::string_view column) const { return table_ && table_->has(column); }
    template <class Row>
    std::vector<Row> rows(Columns<Row> const& columns) const {
        return table_ ? csv_rows(columns, *table_) : std::vector<Row>{};
    }

private:
    std::optional<CsvTable> table_;
};

std::vector<SpeedRow> read_speeds(Table const& table, std::string_view word) {
    std::size_t levels = 0;
    while (table.has(fmt::format("level_{}", levels + 1))) ++levels;
    bool const first_levels = levels == 0 && table.has("reached_1");
    if (first_levels) levels = first_reward_levels.size();
    auto rows = table.rows(speed_columns(word, levels, first_levels));
    if (first_levels)
        for (SpeedRow& row : rows)
            for (std::size_t k = 0; k < levels; ++k) row.to[k].level = first_reward_levels[k];
    return rows;
}

/// The fields that a former report has as misfits: what it cannot know where a world is not at hand.
std::vector<FieldName> misfits_in(Table const& matrix) {
    struct Row {
        std::string source, target, why;
    };
    std::vector<FieldName> misfits;
    for (Row const& row : matrix.rows<Row>(
             {csv_column("source", &Row::source), csv_column("target", &Row::target), csv_column("why", &Row::why)}))
        if (row.why == misfit_word) misfits.push_back({row.source, row.target});
    return misfits;
}

/// Whether the columns of the times have the first worlds' names.
bool has_first_levels(std::vector<SpeedRow> const& speeds, std::string_view word) {
    return is_first(word) &&
           (speeds.empty() ||
            std::equal(first_reward_levels.begin(), first_reward_levels.end(), speeds.front().to.begin(),
                       speeds.front().to.end(), [](double level, TimeToLevel const& to) { return level == to.level; }));
}

}   // namespace

void write_results(CampaignDirectory const& directory, Results const& results) {
    std::string_view const word = results.reward_word();
    bool const first_levels = has_first_levels(results.speeds, word);
    std::size_t const levels =
        results.speeds.empty() ? (first_levels ? first_reward_levels.size() : 0) : results.speeds.front().to.size();
    write(directory, "final.csv", final_columns(word), results.runs);
    write(directory, "runs.csv", run_columns(word), results.runs);
    write(directory, "curves.csv", curve_columns(word), results.curves);
    write(directory, "population.csv", population_columns(word), results.populations);
    write(directory, "kbs.csv", knowledge_columns(word), results.bases);
    write(directory, "speed.csv", speed_columns(word, levels, first_levels), results.speeds);
    write(directory, "leads.csv", lead_columns(word), results.leads);
}

Results read_results(CampaignDirectory const& directory) {
    auto const table = [&](std::string_view name) { return Table{directory, name}; };
    auto const there = [&](std::string_view name) { return is_there(directory.file(name)); };
    auto const required = [&](std::string_view name) {
        return CsvTable::read(directory.file(name), "Make it again from the runs.");
    };
    Results results;
    CsvTable const runs = required(there("runs.csv") ? "runs.csv" : "final.csv");
    std::string_view const word = reward_word(runs.has("reward") ? "" : first_reward_unit);
    results.runs = csv_rows(there("runs.csv") ? run_columns(word) : final_columns(word), runs);
    results.curves = csv_rows(curve_columns(word), required("curves.csv"));
    results.populations = table("population.csv").rows(population_columns(word));
    results.bases = table("kbs.csv").rows(knowledge_columns(word));
    results.speeds = read_speeds(table("speed.csv"), word);
    results.leads = table("leads.csv").rows(lead_columns(word));
    if (Table const matrix = table("matrix.csv"); matrix.has("why")) results.misfits = misfits_in(matrix);
    Replays shown = read_replays(directory);
    results.replays = std::move(shown.replays);
    results.panels = std::move(shown.panels);
    return results;
}

}   // namespace lore
