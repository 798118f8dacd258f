#include <lore/interchange/iohprofiler.h>

#include "new_directory.h"

#include <lore/archive/atomic_file.h>
#include <lore/campaign/finished_runs.h>
#include <lore/core/checksum.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/experiment/config.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/run_directory.h>
#include <lore/world/reward_text.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Of IOHexperimenter, whose `analyzer::v2` logger writes this format; readers ask for 0.3.3 or later.
constexpr char format_version[] = "0.3.23";

/// Networks grow, so that a search space has no dimension; readers want a positive one.
constexpr int dimension = 1;

/// What is optimized: IOHprofiler's function.
struct Problem {
    int id = 0;   ///< from 1
    std::string name;
    WorldRecord world;
    std::string arena_checksum;   ///< of collectball
    ExperimentConfig config;

    /// World, task and episode decide the reward; all else belongs to the algorithm.
    bool same_as(Problem const& other) const {
        if (!why_other(other.world, world).empty() || arena_checksum != other.arena_checksum) return false;
        auto const differences = differing_settings(config, other.config);
        return std::none_of(differences.begin(), differences.end(),
                            [](SettingDifference const& one) { return one.key.starts_with("episode."); });
    }
};

/// For names of files.
std::string plain(std::string const& name) {
    std::string all;
    for (char const c : name) all += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
    return all;
}

/// Tasks of collectball have names of their own; those of other worlds may be called alike.
std::string name_of(Problem const& problem) {
    WorldRecord const& world = problem.world;
    if (!problem.config.has_world() || world.name.empty()) return world.task;
    return world.task.empty() ? world.name : fmt::format("{}_{}", world.name, world.task);
}

/// The treatment's problem, which is added to `problems` if it is new.
Problem const& problem_of(std::string const& run, std::vector<Problem>& problems) {
    Problem problem;
    problem.config = read_config((fs::path{run} / run_file::config).string());
    problem.world = read_manifest((fs::path{run} / run_file::manifest).string()).world;
    if (std::string const arena = (fs::path{run} / run_file::arena).string(); fs::exists(arena))
        problem.arena_checksum = checksum_text(checksum_of_file(arena));
    auto const known =
        std::find_if(problems.begin(), problems.end(), [&](Problem const& one) { return one.same_as(problem); });
    if (known != problems.end()) return *known;
    problem.id = static_cast<int>(problems.size()) + 1;
    problem.name = plain(name_of(problem));
    bool const taken =
        std::any_of(problems.begin(), problems.end(), [&](Problem const& one) { return one.name == problem.name; });
    if (taken) problem.name += fmt::format("_{}", problem.id);
    problems.push_back(std::move(problem));
    return problems.back();
}

/// The record of a run begins at evaluation 1, of which a table of generations tells nothing, with 0 balls, or in other
/// units, which have no least reward, with the mean of generation 0; then come the generations that have improved it,
/// and the last evaluation.
struct Record {
    std::string rows;
    std::uint64_t evaluations = 0;       ///< of the whole run
    std::uint64_t best_evaluation = 1;   ///< by the end of which the best was there
    double best = 0;
};

/// Precondition: there is a generation.
Record record_of(std::vector<GenerationSummary> const& progress, std::string_view reward_unit) {
    Record record;
    auto const add = [&](std::uint64_t evaluation, double reward) {
        record.rows += fmt::format("{} {}\n", evaluation, reward);
        record.evaluations = evaluation;
    };
    if (reward_unit != first_reward_unit) record.best = progress.front().mean_reward;
    add(1, record.best);
    for (GenerationSummary const& generation : progress) {
        if (generation.best_reward <= record.best) continue;
        record.best = generation.best_reward;
        record.best_evaluation = generation.evaluations;
        add(generation.evaluations, generation.best_reward);
    }
    if (progress.back().evaluations != record.evaluations)
        add(progress.back().evaluations, progress.back().best_reward);
    return record;
}

/// Whole ones without a decimal point.
Json number(double reward) { return Json::parse(fmt::format("{}", reward)); }

void write_text(fs::path const& path, std::string const& text) {
    write_file_atomically(path.string(), std::string_view{text});
}

void write_treatment(fs::path const& folder, Treatment const& treatment, Problem const& problem,
                     std::vector<FinishedRun> const& runs) {
    std::string const data_folder = fmt::format("data_f{}_{}", problem.id, problem.name);
    std::string const data_file = fmt::format("{}/IOHprofiler_f{}_DIM{}.dat", data_folder, problem.id, dimension);
    std::string data;
    Json of_runs = Json::array();
    for (FinishedRun const& run : runs) {
        Record const record = record_of(run.progress, problem.world.reward_unit);
        data += "evaluations raw_y\n" + record.rows;
        of_runs.push_back(
            {{"instance", run.number},
             {"evals", record.evaluations},
             {"best", {{"evals", record.best_evaluation}, {"y", number(record.best)}, {"x", Json::array()}}},
             {"seed", run.manifest.seed}});
    }
    Json const scenario{{"dimension", dimension}, {"path", data_file}, {"runs", of_runs}};
    Json const document{{"version", format_version},
                        {"suite", "Lore"},
                        {"function_id", problem.id},
                        {"function_name", problem.name},
                        {"maximization", true},
                        {"algorithm", {{"name", treatment.name}, {"info", treatment.label}}},
                        {"run_attributes", Json::array({"seed"})},
                        {"attributes", Json::array({"evaluations", "raw_y"})},
                        {"scenarios", Json::array({scenario})}};
    make_directory((folder / data_folder).string());
    write_text(folder / data_file, data);
    write_text(folder / fmt::format("IOHprofiler_f{}_{}.json", problem.id, problem.name),
               document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}   // namespace

ExportCounts export_iohprofiler(CampaignPlan const& plan, CampaignDirectory const& directory, std::string const& out) {
    NewDirectory folder{out};
    std::vector<Problem> problems;
    ExportCounts counts;
    for (std::string const& name : all_treatments(plan)) {
        Treatment const& treatment = plan.treatment(name);
        std::vector<FinishedRun> const runs = finished_runs(plan, directory, treatment);
        if (runs.empty()) continue;
        Problem const& problem = problem_of(directory.run(run_step(name, runs.front().number)), problems);
        write_treatment(fs::path{folder.path()} / name, treatment, problem, runs);
        ++counts.treatments;
        counts.runs += static_cast<int>(runs.size());
    }
    if (counts.runs == 0)
        throw UsageError(fmt::format("there is nothing to export in {}", directory.path()), "no run is finished",
                         "Look at 'lore-campaign status'.");
    folder.keep();
    return counts;
}

}   // namespace lore
