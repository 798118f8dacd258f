#include "command.h"

#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/core/progress.h>
#include <lore/evolution/lineage.h>
#include <lore/experiment/knowledge_building.h>
#include <lore/world/reward_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace lore::kb {

namespace {

struct BuildOptions {
    std::string run, out, index = "exact";
    std::optional<int> checks;
    std::optional<std::string> individual;
    bool all = false;
    int every = 1;   ///< of all
    std::optional<int> window_length;
    std::optional<float> threshold;
    std::string value = "mean";
    std::optional<double> gamma;
    std::vector<double> gammas = default_gammas();
    std::optional<double> success;   ///< of all
};

KnowledgeConfig config_of(BuildOptions const& options, RunDirectory const& run) {
    KnowledgeConfig config = run.config.knowledge;
    config.window_length = options.window_length.value_or(config.window_length);
    config.match_threshold = options.threshold.value_or(config.match_threshold);
    config.channels = Channels{run.world.world->facts()};
    if (config.window_length > run.config.episode.steps)
        throw UsageError(fmt::format("cannot build with windows of {} steps", config.window_length),
                         fmt::format("an evaluation of this run has {}", run.config.episode.steps),
                         "Give a shorter --window-length.");
    return config;
}

/// Those that were asked for, in increasing order, each once.
std::vector<double> gammas_of(BuildOptions const& options, ValueConfig const& value) {
    std::vector<double> gammas = options.gammas;
    if (value.rule == ValueRule::discounted_return) gammas.push_back(value.gamma);
    for (double const gamma : gammas) check_gamma(gamma);
    std::sort(gammas.begin(), gammas.end());
    gammas.erase(std::unique(gammas.begin(), gammas.end()), gammas.end());
    if (gammas.size() > most_gammas)
        throw UsageError(fmt::format("cannot gather returns for {} gammas", gammas.size()),
                         fmt::format("at most {} fit into a knowledge base", most_gammas), "Give fewer.");
    return gammas;
}

/// What the end of a long build would say.
void refuse_without_success(BuildOptions const& options, RunDirectory const& run) {
    double const best = run.individual("best")->reward, success = options.success.value_or(usual_success(best));
    if (best >= success) return;
    std::string const& unit = run.world.world->facts().reward_unit;
    throw UsageError(fmt::format("cannot value what {} showed by contrast", options.run),
                     fmt::format("nobody got {} {}, the best {}", reward_text(success), unit, reward_text(best)),
                     "Give a smaller --success, or another --value.");
}

void build(Program const& program, BuildOptions const& options) {
    if (options.all && options.individual)
        throw UsageError("cannot build", "--all takes everybody, --individual the lineage of one", "Leave one out.");
    ValueConfig const value = value_config(options.value, options.gamma, std::nullopt);
    check_evidence_of(options.all ? BuiltFrom::everybody : BuiltFrom::lineage, value.rule);
    std::vector<double> const gammas = gammas_of(options, value);
    check_writable(options.out, FileKind::knowledge_base);
    IndexChoice const index = index_choice(options.index, options.checks);
    RunDirectory const run = open_run(options.run);
    KnowledgeConfig const config = config_of(options, run);
    if (value.rule == ValueRule::contrast) refuse_without_success(options, run);
    auto const individual = run.individual(options.individual.value_or("best"));
    auto const every = static_cast<std::uint64_t>(options.every);
    auto const total = static_cast<std::int64_t>(options.all ? (archived_individuals(run) + every - 1) / every
                                                             : lineage_of(*individual).size());
    Progress progress{"building", total, "individuals", options.all ? 20000 : 500, program.quiet};
    BuildingObserver const observe = [&](std::int64_t done, std::int64_t features) {
        progress.update(done, fmt::format("{} features", features));
    };
    Provenance provenance;
    provenance.made_by = made_by(program);
    std::string const folder = std::filesystem::path{options.out}.parent_path().string();
    KnowledgeBase const base = options.all
                                   ? knowledge_of_all(run, options.every, config, index, provenance, observe, gammas,
                                                      options.success, folder.empty() ? "." : folder)
                                   : knowledge_of_lineage(run, *individual, config, index, provenance, observe, gammas);
    write_knowledge_base(options.out, value.rule == ValueRule::mean ? base : valued(base, value));
    say(program, fmt::format("wrote {}: {} features from {} windows of {} individuals", options.out, base.size(),
                             base.provenance().windows, base.provenance().individuals));
}

}   // namespace

void add_build(CLI::App& app, Program& program) {
    auto const options = std::make_shared<BuildOptions>();
    CLI::App* const command = add_command(app, program, "build", "Build a knowledge base from a run", options, build);
    command->add_option("RUN_DIR", options->run, "directory of a run")->required();
    add_out(command, options->out);
    add_individual(command, options->individual);
    add_index(command, options->index, options->checks);
    auto* const all = command->add_flag(
        "--all", options->all, "from every individual ever evaluated, in order of birth (needs '--archive all')");
    command->add_option("--every", options->every, "of all, only the first and every N-th after it")
        ->check(CLI::Range(1, 1000000000))
        ->needs(all);
    command->add_option("--window-length", options->window_length, "steps a window; default: the run's")
        ->check(CLI::Range(1, longest_window));
    command->add_option("--threshold", options->threshold, "distance below which a window matches; default: the run's")
        ->check(CLI::Range(1e-3, 1e3))
        ->check(a_number);
    add_value(command, options->value, options->gamma, false);
    command
        ->add_option("--gammas", options->gammas,
                     "one or more discounts whose returns are gathered, so that revalue can choose among them")
        ->capture_default_str();
    command
        ->add_option("--success", options->success,
                     "of contrast: so much reward makes a success; default: half of what the best got (of a whole "
                     "number rounded up, at least 1)")
        ->check(a_finite_number)
        ->needs(all);
}

}   // namespace lore::kb
