#include <lore/experiment/run_directory.h>

#include <lore/core/error.h>

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <set>

namespace lore {

std::string text(IndividualId id) { return fmt::format("{}.{}", id.generation, id.slot); }

IndividualId individual_id(std::string_view text) {
    IndividualId id;
    char const* const end = text.data() + text.size();
    auto const generation = std::from_chars(text.data(), end, id.generation);
    if (generation.ec == std::errc{} && generation.ptr != end && *generation.ptr == '.') {
        auto const slot = std::from_chars(generation.ptr + 1, end, id.slot);
        if (slot.ec == std::errc{} && slot.ptr == end) return id;
    }
    throw UsageError(fmt::format("'{}' is no individual", text), "an id is GENERATION.SLOT, such as 312.17",
                     "Take one, or 'best'.");
}

std::string RunDirectory::file(std::string_view name) const { return (std::filesystem::path{path} / name).string(); }

std::shared_ptr<Birth const> RunDirectory::individual(std::string const& which) const {
    if (which == "best") return lineage.find(lineage.best);
    IndividualId const id = individual_id(which);
    try {
        return lineage.find(id);
    } catch (Error const&) {
        throw UsageError(fmt::format("individual {} is not in {}", which, file(run_file::lineage)),
                         "only the ancestors of the last population are kept there", "Take one of them, or 'best'.");
    }
}

namespace {

/// Where the runs are that the user may have meant.
std::string remedy_for_no_run(std::string const& path) {
    std::filesystem::path const runs = std::filesystem::path{path} / "runs";
    std::error_code ignored;
    std::set<std::string> found;
    for (std::filesystem::recursive_directory_iterator at{runs, ignored}, end; at != end; at.increment(ignored)) {
        if (at->path().filename() == run_file::config) found.insert(at->path().parent_path().string());
        if (at.depth() == 2) at.disable_recursion_pending();   // runs/KIND/SEED/config.toml
    }
    if (!found.empty())
        return fmt::format("There are runs in {}: give one, such as {}.", runs.string(), *found.begin());
    return "Give the directory that 'lore-evolve --out' wrote.";
}

}   // namespace

RunDirectory open_unfinished_run(std::string const& path) {
    RunDirectory run;
    run.path = path;
    if (!std::filesystem::is_directory(path))
        throw UsageError(fmt::format("no run in {}", path), "no such directory",
                         "Give the directory that 'lore-evolve --out' wrote.");
    if (!std::filesystem::exists(run.file(run_file::config)))
        throw UsageError(fmt::format("no run in {}", path), fmt::format("there is no {}", run_file::config),
                         remedy_for_no_run(path));
    run.config = read_config(run.file(run_file::config));
    run.world = open_run_world(run.config, arena_text_of(run.config));
    return run;
}

RunDirectory open_run(std::string const& path) {
    RunDirectory run = open_unfinished_run(path);
    if (!std::filesystem::exists(run.file(run_file::lineage)))
        throw Error(fmt::format("no lineage in {}", path),
                    fmt::format("{} is written when a run stops or ends", run_file::lineage),
                    fmt::format("Let it go on with 'lore-evolve --resume --out {}'.", path));
    run.lineage = read_lineage(run.file(run_file::lineage));
    if (std::string const other = why_other(run.lineage.world, run.world.record()); !other.empty())
        throw Error(fmt::format("cannot open the run in {}", path), other,
                    "Give it the world that it was made with, or run it again.");
    return run;
}

}   // namespace lore
