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
}

Results read_results(CampaignDirectory const& directory) {
    auto const there = [&](std::string_view name) { return std::filesystem::exists(directory.file(name)); };
    Results results;
    results.runs =
        there("runs.csv") ? read(directory, "runs.csv", run_columns) : read(directory, "final.csv", final_columns);
    results.curves = read(directory, "curves.csv", curve_columns);
    if (there("population.csv")) results.populations = read(directory, "population.csv", population_columns);
    if (there("kbs.csv")) results.bases = read(directory, "kbs.csv", knowledge_columns);
    Replays shown = read_replays(directory);
    results.replays = std::move(shown.replays);
    results.panels = std::move(shown.panels);
    return results;
}

}   // namespace lore
