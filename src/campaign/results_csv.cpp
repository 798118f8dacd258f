#include <lore/campaign/results.h>

#include "csv_table.h"

#include <lore/archive/atomic_file.h>

#include <filesystem>
#include <iterator>

#include <fmt/format.h>

namespace lore {

namespace {

/// One table's text, a line at a time.
class CsvText {
public:
    explicit CsvText(std::string_view header) { text_.append(header).append("\n"); }
    template <class... Fields>
    void row(fmt::format_string<Fields...> format, Fields&&... fields) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Fields>(fields)...);
        text_ += '\n';
    }
    void write(CampaignDirectory const& directory, std::string_view name) const {
        write_file_atomically(directory.file(name), std::string_view{text_});
    }

private:
    std::string text_;
};

}   // namespace

void write_results(CampaignDirectory const& directory, Results const& results) {
    CsvText final_balls{"treatment,run,seed,balls"};
    CsvText runs{"treatment,run,seed,balls,generations,evaluations,signature,version"};
    for (RunRow const& run : results.runs) {
        final_balls.row("{},{},{},{}", run.treatment, run.run, run.seed, run.balls);
        runs.row("{},{},{},{},{},{},{},{}", run.treatment, run.run, run.seed, run.balls, run.generations,
                 run.evaluations, run.signature, run.version);
    }
    final_balls.write(directory, "final.csv");
    runs.write(directory, "runs.csv");

    CsvText curves{"treatment,generation,runs,mean,low,high"};
    for (CurveRow const& row : results.curves)
        curves.row("{},{},{},{:.4f},{:.4f},{:.4f}", row.treatment, row.generation, row.runs, row.mean, row.low,
                   row.high);
    curves.write(directory, "curves.csv");

    CsvText populations{
        "treatment,generation,runs,mean_balls,fronts,tied,best_shaping,shaping_at_max,connections,hidden"};
    for (PopulationRow const& p : results.populations)
        populations.row("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}", p.treatment, p.generation, p.runs,
                        p.mean_balls, p.fronts, p.tied, p.best_shaping, p.shaping_at_max, p.connections, p.hidden);
    populations.write(directory, "population.csv");

    CsvText bases{"knowledge,kind,source_run,seed,balls,individuals,windows,features,least_value,greatest_value,"
                  "at_greatest,shown_once"};
    for (KnowledgeRow const& b : results.bases)
        bases.row("{},{},{},{},{},{},{},{},{},{},{},{}", b.knowledge, b.kind, b.source_run, b.seed, b.balls,
                  b.individuals, b.windows, b.features, b.least_value, b.greatest_value, b.at_greatest, b.shown_once);
    bases.write(directory, "kbs.csv");

    CsvText replay{"replay,step,x,y,theta,carrying,door_open,switch_on,balls_mask,collected"};
    for (Replay const& shown : results.replays) {
        for (std::size_t k = 0; k < shown.steps.size(); ++k) {
            ReplayStep const& s = shown.steps[k];
            replay.row("{},{},{:.2f},{:.2f},{:.3f},{:d},{:d},{:d},{},{}", shown.step, k, s.x, s.y, s.theta, s.carrying,
                       s.door_open, s.switch_on, s.balls_mask, s.collected);
        }
    }
    replay.write(directory, "replay.csv");

    CsvText values{"figure,knowledge,window,value"};
    for (PanelValues const& panel : results.panels)
        for (std::size_t w = 0; w < panel.values.size(); ++w)
            values.row("{},{},{},{:.4f}", panel.figure, panel.knowledge, w, panel.values[w]);
    values.write(directory, "values.csv");
}

Results read_results(CampaignDirectory const& directory) {
    Results results;
    auto const there = [&](std::string_view name) { return std::filesystem::exists(directory.file(name)); };

    bool const details = there("runs.csv");
    CsvTable const runs = CsvTable::read(directory.file(details ? "runs.csv" : "final.csv"));
    for (std::size_t r = 0; r < runs.rows(); ++r) {
        RunRow row;
        row.treatment = runs.text(r, runs.column("treatment"));
        row.run = runs.integer(r, runs.column("run"));
        row.seed = runs.natural(r, runs.column("seed"));
        row.balls = runs.integer(r, runs.column("balls"));
        if (details) {
            row.generations = runs.integer(r, runs.column("generations"));
            row.evaluations = runs.natural(r, runs.column("evaluations"));
            row.signature = runs.text(r, runs.column("signature"));
            row.version = runs.text(r, runs.column("version"));
        }
        results.runs.push_back(std::move(row));
    }
    CsvTable const curves = CsvTable::read(directory.file("curves.csv"));
    for (std::size_t r = 0; r < curves.rows(); ++r)
        results.curves.push_back({curves.text(r, curves.column("treatment")),
                                  curves.integer(r, curves.column("generation")),
                                  curves.integer(r, curves.column("runs")), curves.number(r, curves.column("mean")),
                                  curves.number(r, curves.column("low")), curves.number(r, curves.column("high"))});
    if (there("population.csv")) {
        CsvTable const table = CsvTable::read(directory.file("population.csv"));
        for (std::size_t r = 0; r < table.rows(); ++r) {
            auto const number = [&](std::string_view column) { return table.number(r, table.column(column)); };
            results.populations.push_back(
                {table.text(r, table.column("treatment")), table.integer(r, table.column("generation")),
                 table.integer(r, table.column("runs")), number("mean_balls"), number("fronts"), number("tied"),
                 number("best_shaping"), number("shaping_at_max"), number("connections"), number("hidden")});
        }
    }
    if (there("kbs.csv")) {
        CsvTable const bases = CsvTable::read(directory.file("kbs.csv"));
        for (std::size_t r = 0; r < bases.rows(); ++r)
            results.bases.push_back(
                {bases.text(r, bases.column("knowledge")), bases.text(r, bases.column("kind")),
                 bases.integer(r, bases.column("source_run")), bases.natural(r, bases.column("seed")),
                 bases.integer(r, bases.column("balls")), bases.natural(r, bases.column("individuals")),
                 bases.natural(r, bases.column("windows")), bases.integer(r, bases.column("features")),
                 bases.number(r, bases.column("least_value")), bases.number(r, bases.column("greatest_value")),
                 bases.integer(r, bases.column("at_greatest")), bases.integer(r, bases.column("shown_once"))});
    }
    if (there("replay.csv")) {
        CsvTable const replay = CsvTable::read(directory.file("replay.csv"));
        for (std::size_t r = 0; r < replay.rows(); ++r) {
            std::string const& step = replay.text(r, replay.column("replay"));
            if (results.replays.empty() || results.replays.back().step != step) results.replays.push_back({step, {}});
            ReplayStep s;
            s.x = static_cast<float>(replay.number(r, replay.column("x")));
            s.y = static_cast<float>(replay.number(r, replay.column("y")));
            s.theta = static_cast<float>(replay.number(r, replay.column("theta")));
            s.carrying = replay.integer(r, replay.column("carrying")) != 0;
            s.door_open = replay.integer(r, replay.column("door_open")) != 0;
            s.switch_on = replay.integer(r, replay.column("switch_on")) != 0;
            s.balls_mask = static_cast<unsigned>(replay.integer(r, replay.column("balls_mask")));
            s.collected = replay.integer(r, replay.column("collected"));
            results.replays.back().steps.push_back(s);
        }
    }
    if (there("values.csv")) {
        CsvTable const values = CsvTable::read(directory.file("values.csv"));
        for (std::size_t r = 0; r < values.rows(); ++r) {
            std::string const &figure = values.text(r, values.column("figure")),
                              &knowledge = values.text(r, values.column("knowledge"));
            if (results.panels.empty() || results.panels.back().figure != figure ||
                results.panels.back().knowledge != knowledge)
                results.panels.push_back({figure, knowledge, {}});
            results.panels.back().values.push_back(values.number(r, values.column("value")));
        }
    }
    return results;
}

}   // namespace lore
