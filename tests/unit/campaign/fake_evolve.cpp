// Stands in for lore-evolve in the campaign's tests: takes its arguments, writes its files, makes up the numbers.
//
// Environment: LORE_FAKE_MS  milliseconds a generation (default 0)
//              LORE_FAKE_FAIL  "NAME:SEED:TIMES[:CODE],..." the run of this treatment (* any) and seed fails so often,
//                              with this exit code (default 1)
//              LORE_FAKE_COUNT  directory in which every start leaves a file

#include <lore/core/error.h>
#include <lore/core/random.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

namespace {

using namespace lore;
namespace fs = std::filesystem;

volatile std::sig_atomic_t stop = 0;
void request_stop(int) { stop = 1; }

std::string from_environment(char const* name) {
    char const* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// The exit code with which this start shall fail, or 0; counts the starts in a file beside the run.
int failure_wanted(std::string const& treatment, std::string const& seed, std::string const& out) {
    std::istringstream rules{from_environment("LORE_FAKE_FAIL")};
    for (std::string rule; std::getline(rules, rule, ',');) {
        std::istringstream fields{rule};
        std::string name, of_seed, times, code;
        std::getline(fields, name, ':');
        std::getline(fields, of_seed, ':');
        std::getline(fields, times, ':');
        std::getline(fields, code, ':');
        if ((name != "*" && name != treatment) || of_seed != seed) continue;
        fs::create_directories(out);
        int failed = 0;
        {
            std::ifstream former{out + "/failed-so-often"};
            former >> failed;
        }
        if (failed >= std::stoi(times)) return 0;
        std::ofstream{out + "/failed-so-often"} << failed + 1;
        return code.empty() ? 1 : std::stoi(code);
    }
    return 0;
}

}   // namespace

int main(int argc, char** argv) {
    std::vector<std::string> const arguments(argv + 1, argv + argc);
    std::string config_path, seed = "1", out, kb;
    std::vector<std::string> overrides, founders;
    bool archive_all = false;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        std::string const& word = arguments[i];
        if (word == "--resume") continue;
        if (!word.starts_with("--")) {
            config_path = word;
            continue;
        }
        if (word == "--founders") {
            for (; i + 1 < arguments.size() && !arguments[i + 1].starts_with("--"); ++i) {
                std::string const& from = arguments[i + 1];
                founders.push_back(fs::is_directory(from) ? from + "/" + run_file::lineage : from);
            }
            continue;
        }
        std::string const& value = arguments[++i];
        if (word == "--seed") seed = value;
        if (word == "--out") out = value;
        if (word == "--kb") kb = value;
        if (word == "--set") overrides.push_back(value);
        if (word == "--archive") archive_all = value == "all";
    }
    for (int const signal : {SIGUSR1, SIGINT, SIGTERM}) std::signal(signal, request_stop);
    std::string const treatment = fs::path{out}.parent_path().filename().string();
    if (auto const count = from_environment("LORE_FAKE_COUNT"); !count.empty())
        std::ofstream{count + "/" + treatment + "-" + seed + "-" + std::to_string(::getpid())} << "started\n";
    if (int const code = failure_wanted(treatment, seed, out); code != 0) {
        std::fprintf(stderr, "lore-evolve: the fake fails (it was told to). Nothing helps.\n");
        return code;
    }
    if (!kb.empty() && !fs::exists(kb)) {
        std::fprintf(stderr, "lore-evolve: cannot read %s (no such file). Check the path.\n", kb.c_str());
        return 2;
    }
    try {
        ExperimentConfig config = read_config(config_path, overrides);
        config.evolution.use_shaping = !kb.empty();
        fs::create_directories(out);
        std::ofstream{out + "/" + run_file::config} << to_toml(config);
        int const milliseconds = std::atoi(from_environment("LORE_FAKE_MS").c_str());

        Manifest manifest;
        manifest.seed = std::stoull(seed);
        manifest.name = config.name;
        manifest.task = config.task;
        // Of another unit rewards are negative and not whole.
        std::string const unit = from_environment("LORE_FAKE_UNIT");
        manifest.world.reward_unit = unit.empty() ? "balls" : unit;
        if (!unit.empty()) {
            manifest.world.name = manifest.world.task = "toy";
            manifest.world.channels = {std::vector<ChannelInfo>{{"sensor"}}, std::vector<ChannelInfo>{{"effector"}}};
        }
        manifest.generations = config.evolution.generations;
        manifest.build = build_information();
        if (!kb.empty()) manifest.inputs.push_back(record_of_text(file_role::knowledge, "", kb));
        for (std::string const& from : founders)
            manifest.inputs.push_back(record_of_text(file_role::founders, "", from));

        std::string const progress = out + "/" + run_file::progress;
        int generation = 0;
        if (fs::exists(progress)) generation = static_cast<int>(read_progress(progress).size());
        else std::ofstream{progress} << progress_header(manifest.world.reward_unit) << "\n";
        // The reward rises with the generations to a level that the treatment and the seed decide.
        Stream rng{manifest.seed, Purpose::test, static_cast<std::uint32_t>(treatment.size() + kb.size() % 7)};
        double const level = 2 + rng.below(5) + (kb.empty() ? 0 : 2);
        for (; generation <= config.evolution.generations; ++generation) {
            GenerationSummary row;
            row.generation = generation;
            row.best_reward = std::floor(level * generation / config.evolution.generations);
            if (!unit.empty()) row.best_reward = row.mean_reward = 0.125 * row.best_reward - 10.5;
            row.evaluations = 400 + 200ull * static_cast<unsigned>(generation);
            row.seconds = 0.001 * milliseconds * generation;
            std::ofstream{progress, std::ios::app} << text(row) << "\n";
            manifest.generation = generation;
            manifest.best_reward = row.best_reward;
            manifest.status = RunStatus::interrupted;
            if (stop != 0 && generation < config.evolution.generations) {
                write_manifest(out + "/" + run_file::manifest, manifest);
                std::fprintf(stderr, "lore-evolve: stopped at generation %d\n", generation);
                return static_cast<int>(ExitCode::interrupted);
            }
            if (generation == 0) write_manifest(out + "/" + run_file::manifest, manifest);
            if (milliseconds > 0) std::this_thread::sleep_for(std::chrono::milliseconds{milliseconds});
        }
        std::ofstream{out + "/" + run_file::lineage} << "a lineage\n";
        if (archive_all) std::ofstream{out + "/" + run_file::all_individuals} << "everybody\n";
        manifest.status = RunStatus::done;
        manifest.signature = "00000000" + std::string(8 - std::min<std::size_t>(8, seed.size()), '0') + seed;
        write_manifest(out + "/" + run_file::manifest, manifest);
        std::printf("signature: %s\n", manifest.signature.c_str());
        return 0;
    } catch (Error const& error) {
        std::fprintf(stderr, "lore-evolve: %s\n", error.what());
        return static_cast<int>(error.exit_code());
    }
}
