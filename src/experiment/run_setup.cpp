#include "run_setup.h"

#include "founders.h"
#include "run_resumption.h"

#include <lore/archive/atomic_file.h>
#include <lore/collectball/arena.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/utf8.h>
#include <lore/experiment/run_directory.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace lore {

namespace fs = std::filesystem;

namespace {

constexpr char several_kinds[] = "several kinds";   ///< FoundersOrigin::kind of founders that are not all of one

/// A run that lost its configuration is not written over.
void refuse_remains(RunSetup const& setup) {
    for (char const* const remains : {run_file::checkpoint, run_file::older_checkpoint, run_file::lineage,
                                      run_file::progress, run_file::all_individuals})
        if (fs::exists(setup.file(remains)))
            throw UsageError(fmt::format("{} holds what is left of a run", setup.directory),
                             fmt::format("there is a {}, but no {}", remains, run_file::config),
                             fmt::format("Put {} back, or choose another directory with --out.", run_file::config));
}

/// A knowledge base shapes the reward, whatever a configuration says; the command line must not say both.
void refuse_idle_knowledge(RunOptions const& options) {
    if (forbids_shaping(options) && !options.knowledge_base.empty())
        throw UsageError(fmt::format("cannot take {}", options.knowledge_base),
                         "--set evolution.use_shaping=false leaves it without use", "Leave out one of the two.");
}

void start_anew(RunSetup& setup, RunOptions const& options) {
    if (options.config_path.empty())
        throw UsageError(fmt::format("there is no run in {} to go on with", options.directory),
                         fmt::format("it has no {}, and no configuration to start with was given", run_file::config),
                         "Check --out, or name one, such as jobs/tasks/source.toml.");
    setup.order.config = parse_config(setup.given, options.overrides);
    setup.order.arena_text = arena_text_of(setup.order.config);
    if (!options.knowledge_base.empty()) setup.order.take_knowledge(options.knowledge_base);
    setup.seed = options.seed.value_or(1);
    setup.archive_all = options.archive_all;
    setup.manifest.inputs.push_back(record_of_text(file_role::configuration, setup.given.text, setup.given.path));
    if (!setup.order.config.has_world() && !is_builtin_arena(setup.order.config.arena))
        setup.manifest.inputs.push_back(
            record_of_text(file_role::arena, setup.order.arena_text, setup.order.config.arena));
    if (!options.knowledge_base.empty())
        setup.manifest.inputs.push_back(
            record_of(file_role::knowledge, options.knowledge_base, setup.order.knowledge_path));
    if (std::vector<std::string>& from = setup.order.config.founders_from; !from.empty()) {
        for (std::string& one : from) one = absolute_path(one);
        for (FileRecord& record : founders_records(from)) setup.manifest.inputs.push_back(std::move(record));
        setup.founders_are_due = true;
    }
}

/// A start writes the configuration last, so the other files are there if it is.
bool holds_a_run(RunSetup const& setup) { return fs::exists(setup.file(run_file::config)); }

/// Opens the world. A run keeps to the one that it was started with.
RunWorld settle_world(RunSetup& setup) {
    ExperimentConfig& config = setup.order.config;
    RunWorld world = open_run_world(config, setup.order.arena_text);
    WorldRecord record = world.record();
    bool const resumed = !setup.manifest.sessions.empty();
    if (std::string const other = resumed ? why_other(setup.manifest.world, record) : ""; !other.empty())
        throw UsageError(fmt::format("cannot go on with {}", setup.directory), other,
                         "Give it the world that it was started with, or start in another directory.");
    int const pairs = record.channels.sensors() * record.channels.effectors();
    if (config.evolution.limits.max_edges < pairs)
        throw UsageError(
            "limits.max_edges is too small",
            fmt::format("founders have {} connections, one from every sensor to every effector, and it is {}", pairs,
                        config.evolution.limits.max_edges),
            "Set it higher.");
    setup.order.world_checksum = world.origin.checksum;
    if (config.has_world()) config.world.folder = absolute_path(config.world.folder);
    if (!world.origin.file.empty()) {
        config.world.name = absolute_path(world.origin.file);
        if (!resumed)
            setup.manifest.inputs.push_back(record_of(file_role::world, config.world.name, config.world.name));
    }
    setup.manifest.world = std::move(record);
    return world;
}

/// config.toml, and what other ranks are told, is UTF-8: a path that is not could not be read again.
void refuse_unreadable_paths(ExperimentConfig const& config, std::string const& knowledge_path) {
    std::vector<std::string> paths = config.founders_from;
    paths.insert(paths.end(), {config.world.folder, config.world.name, config.arena, knowledge_path});
    for (std::string const& path : paths)
        if (!is_printable(path))
            throw UsageError(fmt::format("cannot take {}", path), "the path is no printable UTF-8",
                             "Rename the folder, or work in another.");
}

/// What a start and a resumption have in common: the settings fit each other, the checkpoint and the knowledge base.
void settle(PreparedRun& run, RunOptions const& options) {
    RunSetup& setup = run.setup;
    RunWorld world = settle_world(setup);
    if (setup.founders_are_due)
        setup.founders = read_founder_genomes(setup.order.config.founders_from, setup.manifest.world.channels,
                                              setup.order.config.evolution, setup.seed);
    if (setup.order.config.evolution.use_shaping && setup.order.knowledge_path.empty())
        throw UsageError("evolution.use_shaping is true", "no knowledge base is given", "Give one with --kb.");
    refuse_unreadable_paths(setup.order.config, setup.order.knowledge_path);
    check_digest(setup);
    int const reached = setup.checkpoint ? setup.checkpoint->state.population.generation : -1;
    if (reached > setup.order.config.evolution.generations)
        throw UsageError(fmt::format("cannot go on with {}", options.directory),
                         fmt::format("it has reached generation {}, evolution.generations is {}", reached,
                                     setup.order.config.evolution.generations),
                         "Set evolution.generations higher.");
    setup.already_done =
        setup.manifest.status == RunStatus::done && reached == setup.order.config.evolution.generations;
    setup.manifest.name = setup.order.config.name;
    setup.manifest.task = setup.manifest.world.task;
    setup.manifest.seed = setup.seed;
    setup.manifest.generations = setup.order.config.evolution.generations;
    setup.manifest.build = build_information();
    run.context = context_of(setup.order, std::move(world));
}

}   // namespace

std::string RunSetup::file(std::string_view name) const { return (fs::path{directory} / name).string(); }

std::optional<FoundersOrigin> RunSetup::founders_origin() const {
    std::optional<FoundersOrigin> all;
    for (FileRecord const& record : with_role(manifest.inputs, file_role::founders)) {
        if (!all) {
            all = {record.kind, record.path, record.checksum};
            continue;
        }
        if (all->kind != record.kind) all->kind = several_kinds;
        all->path += ", " + record.path;
        all->checksum += ", " + record.checksum;
    }
    return all;
}

bool forbids_shaping(RunOptions const& options) {
    return std::ranges::any_of(options.overrides, [](std::string setting) {
        std::erase(setting, ' ');
        return setting == "evolution.use_shaping=false";
    });
}

PreparedRun prepare_run(RunOptions const& options) {
    PreparedRun run;
    RunSetup& setup = run.setup;
    setup.directory = options.directory;
    refuse_idle_knowledge(options);
    if (!options.config_path.empty()) setup.given = read_config_file(options.config_path);
    bool const resumed = holds_a_run(setup);
    if (resumed && !options.resume)
        throw UsageError(fmt::format("{} already holds a run", options.directory),
                         fmt::format("there is a {}", run_file::config),
                         "Continue it with --resume, or choose another directory with --out.");
    // What a new run is refused for is found before there is a directory.
    if (!resumed) {
        start_anew(setup, options);
        settle(run, options);
    }
    make_directory(options.directory);
    run.lock = FileLock::take(setup.file(run_file::lock));
    if (!run.lock)
        throw Error(fmt::format("another process runs in {}", options.directory), "it holds the lock",
                    "Wait for it, or choose another directory with --out.");
    if (holds_a_run(setup) != resumed)
        throw Error(fmt::format("another process runs in {}", options.directory), "it started there at this moment",
                    "Wait for it, or choose another directory with --out.");
    if (!resumed) refuse_remains(setup);
    remove_leftovers(options.directory);
    if (resumed) {
        resume(setup, options);
        settle(run, options);
    }
    return run;
}

}   // namespace lore
