#include "run_setup.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/checksum.h>
#include <lore/core/error.h>
#include <lore/experiment/run_directory.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace lore {

namespace fs = std::filesystem;

namespace {

constexpr char role_configuration[] = "configuration";
constexpr char role_arena[] = "arena";
constexpr char role_knowledge[] = "knowledge base";

std::string as_text(std::vector<std::byte> const& bytes) {
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

void make_directory(std::string const& directory) {
    std::error_code failed;
    fs::create_directories(directory, failed);
    if (failed || !fs::is_directory(directory))
        throw Error(fmt::format("cannot make the directory {}", directory),
                    failed ? failed.message() : "there is a file of that name", "Choose another with --out.");
}

/// Settings that a resumed run may change: they do not touch what has been computed.
bool may_change(std::string const& key) {
    return key == "evolution.generations" || key == "name" || key == "arena" || key.starts_with("checkpoint.");
}

std::uint64_t digest_of(RunSetup const& setup) {
    ExperimentConfig config = setup.order.config;
    ExperimentConfig const standard;
    config.name = config.arena = "";
    config.evolution.generations = 0;
    config.checkpoint_generations = standard.checkpoint_generations;
    config.checkpoint_minutes = standard.checkpoint_minutes;
    return checksum(fmt::format("{}\n{}\n{}\n{}", to_toml(config), setup.order.arena_text,
                                setup.order.knowledge_checksum, setup.seed));
}

void take_knowledge(RunSetup& setup, std::string const& path) {
    if (path.empty()) return;
    std::error_code failed;
    setup.order.knowledge_path = fs::absolute(path, failed).string();
    setup.order.knowledge_checksum = checksum_text(checksum_of_file(path));
    setup.order.config.evolution.use_shaping = true;
}

/// A run that lost its configuration is not written over.
void refuse_remains(RunSetup const& setup) {
    for (char const* const remains : {run_file::checkpoint, run_file::older_checkpoint, run_file::lineage,
                                      run_file::progress, run_file::all_individuals})
        if (fs::exists(setup.file(remains)))
            throw UsageError(fmt::format("{} holds what is left of a run", setup.directory),
                             fmt::format("there is a {}, but no {}", remains, run_file::config),
                             fmt::format("Put {} back, or choose another directory with --out.", run_file::config));
}

void start_anew(RunSetup& setup, RunOptions const& options) {
    if (options.config_path.empty())
        throw UsageError(fmt::format("nothing to start in {}", options.directory), "no configuration was given",
                         "Name one, such as jobs/tasks/source.toml.");
    setup.order.config = read_config(options.config_path, options.overrides);
    setup.order.arena_text = arena_text(setup.order.config.arena);
    take_knowledge(setup, options.knowledge_base);
    setup.seed = options.seed.value_or(1);
    setup.archive_all = options.archive_all;
    setup.manifest.inputs.push_back(record_of(role_configuration, options.config_path, options.config_path));
    if (fs::exists(setup.order.config.arena))
        setup.manifest.inputs.push_back(record_of(role_arena, setup.order.config.arena, setup.order.config.arena));
    if (!options.knowledge_base.empty())
        setup.manifest.inputs.push_back(record_of(role_knowledge, options.knowledge_base, setup.order.knowledge_path));
}

/// What the command line says again when it resumes a run must be what the run was started with.
void refuse_other_settings(RunSetup const& setup, RunOptions const& options, ExperimentConfig const& recorded) {
    if (options.config_path.empty()) return;
    ExperimentConfig given = read_config(options.config_path, options.overrides);
    given.evolution.use_shaping = recorded.evolution.use_shaping;
    std::vector<std::string> changed;
    for (std::string const& key : differing_settings(given, recorded))
        if (!may_change(key)) changed.push_back(key);
    if (!changed.empty())
        throw UsageError(fmt::format("cannot go on with {} under another configuration", options.directory),
                         fmt::format("it was started with another {}", fmt::join(changed, ", ")),
                         fmt::format("Compare {}, or start in another directory.", setup.file(run_file::config)));
    if (arena_text(given.arena) != setup.order.arena_text)
        throw UsageError(fmt::format("cannot go on with {} in another arena", options.directory),
                         fmt::format("{} has changed since", given.arena), "Start in another directory.");
}

void refuse_another_seed(RunSetup const& setup, RunOptions const& options) {
    if (options.seed && *options.seed != setup.seed)
        throw UsageError(fmt::format("cannot go on with {} with another seed", options.directory),
                         fmt::format("it was started with --seed {}", setup.seed),
                         "Leave out --seed, or start in another directory.");
}

void go_on(RunSetup& setup, RunOptions const& options) {
    ExperimentConfig const recorded = read_config(setup.file(run_file::config));
    setup.order.arena_text = as_text(read_file(setup.file(run_file::arena)));
    refuse_other_settings(setup, options, recorded);
    std::vector<std::string> late;   // of --set, those that may change
    for (std::string const& override : options.overrides) {
        std::string const key = override.substr(0, override.find('='));
        if (may_change(key) || options.config_path.empty()) late.push_back(override);
        if (options.config_path.empty() && !may_change(key))
            throw UsageError(fmt::format("--set {} comes too late", override), "the run was started without it",
                             "Start in another directory.");
    }
    setup.order.config = read_config(setup.file(run_file::config), late);
    if (!options.config_path.empty()) {
        ExperimentConfig const given = read_config(options.config_path, options.overrides);
        setup.order.config.evolution.generations = given.evolution.generations;
        setup.order.config.checkpoint_generations = given.checkpoint_generations;
        setup.order.config.checkpoint_minutes = given.checkpoint_minutes;
    }

    if (fs::exists(setup.file(run_file::manifest))) setup.manifest = read_manifest(setup.file(run_file::manifest));
    FileRecord const* const knowledge = find_role(setup.manifest.inputs, role_knowledge);
    std::string const former = knowledge == nullptr ? "" : knowledge->path;
    if (options.knowledge_base.empty() && !former.empty() && !fs::exists(former))
        throw UsageError(fmt::format("cannot go on with {}", options.directory),
                         fmt::format("its knowledge base {} is not there any more", former),
                         "Say where it is now with --kb.");
    if (setup.order.config.evolution.use_shaping)
        take_knowledge(setup, options.knowledge_base.empty() ? former : options.knowledge_base);
    else if (!options.knowledge_base.empty())
        throw UsageError(fmt::format("cannot go on with {} with a knowledge base", options.directory),
                         "the run was started without one", "Leave out --kb, or start in another directory.");
    if (knowledge != nullptr && setup.order.knowledge_checksum != knowledge->checksum)
        throw UsageError(fmt::format("cannot go on with {} with another knowledge base", options.directory),
                         fmt::format("{} is not the file it was started with", setup.order.knowledge_path),
                         "Give that one with --kb.");
    setup.archive_all = options.archive_all;

    bool const has_checkpoint =
        fs::exists(setup.file(run_file::checkpoint)) || fs::exists(setup.file(run_file::older_checkpoint));
    if (!has_checkpoint) {   // killed before the first one
        setup.seed = setup.manifest.sessions.empty() ? options.seed.value_or(1) : setup.manifest.seed;
        refuse_another_seed(setup, options);
        setup.archive_all = setup.archive_all || fs::exists(setup.file(run_file::all_individuals));
        return;
    }
    FoundCheckpoint found = read_checkpoint(setup.file(run_file::checkpoint), setup.file(run_file::older_checkpoint));
    setup.warning = std::move(found.warning);
    setup.checkpoint = std::move(found.checkpoint);
    setup.seed = setup.manifest.sessions.empty() ? setup.checkpoint->seed : setup.manifest.seed;
    refuse_another_seed(setup, options);
    bool const archived = setup.checkpoint->all_individuals.bytes > 0;
    if (options.archive_all && !archived)
        throw UsageError(fmt::format("cannot archive all individuals of {}", options.directory),
                         "the run was started without --archive all", "Leave it out, or start in another directory.");
    setup.archive_all = archived;
}

/// A run's configuration is the last of what its start writes, and so tells that the rest is there.
bool holds_a_run(RunSetup const& setup) { return fs::exists(setup.file(run_file::config)); }

/// What a start and a resumption have in common: the settings fit each other, the checkpoint and the knowledge base.
void settle(PreparedRun& run, RunOptions const& options) {
    RunSetup& setup = run.setup;
    if (setup.order.config.evolution.use_shaping && setup.order.knowledge_path.empty())
        throw UsageError("evolution.use_shaping is true", "no knowledge base is given", "Give one with --kb.");
    setup.digest = digest_of(setup);
    if (setup.checkpoint && (setup.checkpoint->config_digest != setup.digest || setup.checkpoint->seed != setup.seed))
        throw UsageError(fmt::format("cannot go on with {}", options.directory),
                         fmt::format("{} or {} was changed since its checkpoint", run_file::config, run_file::arena),
                         "Restore them.");
    int const reached = setup.checkpoint ? setup.checkpoint->state.population.generation : -1;
    if (reached > setup.order.config.evolution.generations)
        throw UsageError(fmt::format("cannot go on with {}", options.directory),
                         fmt::format("it has reached generation {}, evolution.generations is {}", reached,
                                     setup.order.config.evolution.generations),
                         "Set evolution.generations higher.");
    setup.already_done =
        setup.manifest.status == RunStatus::done && reached == setup.order.config.evolution.generations;
    setup.manifest.name = setup.order.config.name;
    setup.manifest.task = setup.order.config.task;
    setup.manifest.seed = setup.seed;
    setup.manifest.generations = setup.order.config.evolution.generations;
    setup.manifest.build = build_information();
    run.context = context_of(setup.order);
}

}   // namespace

DirectoryLock::DirectoryLock(std::string const& directory) {
    std::string const path = (fs::path{directory} / run_file::lock).string();
    file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0)
        throw Error(fmt::format("cannot write into {}", directory), std::strerror(errno),
                    "Choose another directory with --out.");
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    int const reason = errno;
    ::close(file_);
    if (reason == EWOULDBLOCK)
        throw Error(fmt::format("another process runs in {}", directory), "it holds the lock",
                    "Wait for it, or choose another directory with --out.");
    throw Error(fmt::format("cannot lock {}", path), std::strerror(reason),
                "Choose a directory on another file system.");
}

DirectoryLock::~DirectoryLock() { ::close(file_); }

std::string RunSetup::file(std::string_view name) const { return (fs::path{directory} / name).string(); }

PreparedRun prepare_run(RunOptions const& options) {
    PreparedRun run;
    RunSetup& setup = run.setup;
    setup.directory = options.directory;
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
    run.lock = std::make_unique<DirectoryLock>(options.directory);
    if (holds_a_run(setup) != resumed)
        throw Error(fmt::format("another process runs in {}", options.directory), "it started there at this moment",
                    "Wait for it, or choose another directory with --out.");
    if (!resumed) refuse_remains(setup);
    remove_leftovers(options.directory);
    if (resumed) {
        go_on(setup, options);
        settle(run, options);
    }
    return run;
}

}   // namespace lore
