#include "results.h"

#include "csv_columns.h"

#include <lore/archive/atomic_file.h>

#include <filesystem>

namespace lore {

namespace {

// A new column is one line here, and a member of the row; one that older files lack is marked as optional.

std::vector<CsvColumn<RunRow>> const final_columns{csv_column("treatment", &RunRow::treatment),
                                                   csv_column("run", &RunRow::run), csv_column("seed", &RunRow::seed),
                                                   csv_column("balls", &RunRow::balls)};

std::vector<CsvColumn<RunRow>> const run_columns{csv_column("treatment", &RunRow::treatment),
                                                 csv_column("run", &RunRow::run),
                                                 csv_column("seed", &RunRow::seed),
                                                 csv_column("balls", &RunRow::balls),
                                                 csv_column("generations", &RunRow::generations),
                                                 csv_column("evaluations", &RunRow::evaluations),
                                                 csv_column("signature", &RunRow::signature),
                                                 csv_column("version", &RunRow::version)};

std::vector<CsvColumn<CurveRow>> const curve_columns{
    csv_column("treatment", &CurveRow::treatment), csv_column("generation", &CurveRow::generation),
    csv_column("runs", &CurveRow::runs),           csv_column("mean", &CurveRow::mean, rounded),
    csv_column("low", &CurveRow::low, rounded),    csv_column("high", &CurveRow::high, rounded)};

std::vector<CsvColumn<PopulationRow>> const population_columns{
    csv_column("treatment", &PopulationRow::treatment),
    csv_column("generation", &PopulationRow::generation),
    csv_column("runs", &PopulationRow::runs),
    csv_column("mean_balls", &PopulationRow::mean_balls, rounded),
    csv_column("fronts", &PopulationRow::fronts, rounded),
    csv_column("tied", &PopulationRow::tied, rounded),
    csv_column("best_shaping", &PopulationRow::best_shaping, rounded),
    csv_column("shaping_at_max", &PopulationRow::shaping_at_max, rounded),
    csv_column("connections", &PopulationRow::connections, rounded),
    csv_column("hidden", &PopulationRow::hidden, rounded)};

std::vector<CsvColumn<KnowledgeRow>> const knowledge_columns{
    csv_column("knowledge", &KnowledgeRow::knowledge),
    csv_column("kind", &KnowledgeRow::kind),
    csv_column("source_run", &KnowledgeRow::source_run),
    csv_column("seed", &KnowledgeRow::seed),
    csv_column("balls", &KnowledgeRow::balls),
    csv_column("individuals", &KnowledgeRow::individuals),
    csv_column("windows", &KnowledgeRow::windows),
    csv_column("features", &KnowledgeRow::features),
    csv_column("least_value", &KnowledgeRow::least_value),
    csv_column("greatest_value", &KnowledgeRow::greatest_value),
    csv_column("at_greatest", &KnowledgeRow::at_greatest),
    csv_column("shown_once", &KnowledgeRow::shown_once)};

/// A number of the time to the which-th of timed_balls.
template <class Value>
CsvColumn<SpeedRow> time_column(std::string_view name, std::size_t which, Value TimeToBalls::*member) {
    CsvColumn<TimeToBalls> const column = csv_column(name, member, rounded);
    return {name, [=](std::string& text, SpeedRow const& row) { column.write(text, row.to[which]); },
            [=](CsvTable const& table, std::size_t r, std::size_t c, SpeedRow& row) {
                column.read(table, r, c, row.to[which]);
            }};
}

std::vector<CsvColumn<SpeedRow>> const speed_columns{
    csv_column("treatment", &SpeedRow::treatment),         csv_column("runs", &SpeedRow::runs),
    csv_column("generations", &SpeedRow::generations),     time_column("reached_1", 0, &TimeToBalls::reached),
    time_column("time_1", 0, &TimeToBalls::mean),          time_column("time_1_low", 0, &TimeToBalls::low),
    time_column("time_1_high", 0, &TimeToBalls::high),     time_column("median_1", 0, &TimeToBalls::median),
    time_column("reached_3", 1, &TimeToBalls::reached),    time_column("time_3", 1, &TimeToBalls::mean),
    time_column("time_3_low", 1, &TimeToBalls::low),       time_column("time_3_high", 1, &TimeToBalls::high),
    time_column("median_3", 1, &TimeToBalls::median),      time_column("reached_5", 2, &TimeToBalls::reached),
    time_column("time_5", 2, &TimeToBalls::mean),          time_column("time_5_low", 2, &TimeToBalls::low),
    time_column("time_5_high", 2, &TimeToBalls::high),     time_column("median_5", 2, &TimeToBalls::median),
    csv_column("area", &SpeedRow::area, rounded),          csv_column("area_low", &SpeedRow::area_low, rounded),
    csv_column("area_high", &SpeedRow::area_high, rounded)};

std::vector<CsvColumn<LeadRow>> const lead_columns{csv_column("treatment", &LeadRow::treatment),
                                                   csv_column("policy", &LeadRow::policy),
                                                   csv_column("none", &LeadRow::none),
                                                   csv_column("generation", &LeadRow::generation),
                                                   csv_column("balls", &LeadRow::balls, rounded),
                                                   csv_column("policy_balls", &LeadRow::policy_balls, rounded),
                                                   csv_column("none_balls", &LeadRow::none_balls, rounded),
                                                   csv_column("share", &LeadRow::share, rounded)};

template <class Row>
void write(CampaignDirectory const& directory, std::string_view name, std::vector<CsvColumn<Row>> const& columns,
           std::vector<Row> const& rows) {
    write_file_atomically(directory.file(name), std::string_view{csv_text(columns, rows)});
}

template <class Row>
std::vector<Row> read(CampaignDirectory const& directory, std::string_view name,
                      std::vector<CsvColumn<Row>> const& columns) {
    return csv_rows(columns, CsvTable::read(directory.file(name), "Make it again from the runs."));
}

}   // namespace

void write_results(CampaignDirectory const& directory, Results const& results) {
    write(directory, "final.csv", final_columns, results.runs);
    write(directory, "runs.csv", run_columns, results.runs);
    write(directory, "curves.csv", curve_columns, results.curves);
    write(directory, "population.csv", population_columns, results.populations);
    write(directory, "kbs.csv", knowledge_columns, results.bases);
    write(directory, "speed.csv", speed_columns, results.speeds);
    write(directory, "leads.csv", lead_columns, results.leads);
}

Results read_results(CampaignDirectory const& directory) {
    auto const there = [&](std::string_view name) { return std::filesystem::exists(directory.file(name)); };
    Results results;
    results.runs =
        there("runs.csv") ? read(directory, "runs.csv", run_columns) : read(directory, "final.csv", final_columns);
    results.curves = read(directory, "curves.csv", curve_columns);
    if (there("population.csv")) results.populations = read(directory, "population.csv", population_columns);
    if (there("kbs.csv")) results.bases = read(directory, "kbs.csv", knowledge_columns);
    if (there("speed.csv")) results.speeds = read(directory, "speed.csv", speed_columns);
    if (there("leads.csv")) results.leads = read(directory, "leads.csv", lead_columns);
    Replays shown = read_replays(directory);
    results.replays = std::move(shown.replays);
    results.panels = std::move(shown.panels);
    return results;
}

}   // namespace lore
