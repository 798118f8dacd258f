#include "run_resumption.h"

#include "founders.h"
#include "run_digest.h"

#include <lore/core/error.h>
#include <lore/core/input_file.h>
#include <lore/experiment/run_directory.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace lore {

namespace fs = std::filesystem;

namespace {

UsageError cannot_go_on(RunSetup const& setup, std::string_view with, std::string const& reason,
                        std::string_view remedy) {
    return {fmt::format("cannot go on with {}{}", setup.directory, with), reason, remedy};
}

/// The configuration to go on with: the one named again on the command line, or the run's own, with the overrides.
/// A command line that is repeated must mean the same run; only what does not affect results may differ.
ExperimentConfig configuration_to_go_on_with(RunSetup const& setup, RunOptions const& options) {
    std::string const own = setup.file(run_file::config);
    ExperimentConfig const recorded = read_config(own);
    ExperimentConfig wanted =
        setup.given.path.empty() ? read_config(own, options.overrides) : parse_config(setup.given, options.overrides);
    if (recorded.evolution.use_shaping && !forbids_shaping(options))
        wanted.evolution.use_shaping = true;   // --kb had set it
    if (auto const others = differing_result_settings(recorded, wanted); !others.empty())
        throw cannot_go_on(setup, " under another configuration", fmt::format("it was started with {}", text(others)),
                           fmt::format("Compare {}, or start in another directory.", own));
    if (arena_text_of(wanted) != setup.order.arena_text)
        throw cannot_go_on(setup, " in another arena", fmt::format("{} has changed since", wanted.arena),
                           "Start in another directory.");
    return wanted;
}

/// The knowledge base of the run, wherever it is now.
void find_knowledge(RunSetup& setup, RunOptions const& options) {
    FileRecord const* const recorded = find_role(setup.manifest.inputs, file_role::knowledge);
    if (!setup.order.config.evolution.use_shaping) {
        if (!options.knowledge_base.empty())
            throw cannot_go_on(setup, " with a knowledge base", "the run was started without one",
                               "Leave out --kb, or start in another directory.");
        return;
    }
    std::string path = options.knowledge_base;
    if (path.empty() && recorded != nullptr) {
        path = recorded->path;
        if (!fs::exists(path))
            throw cannot_go_on(setup, "", fmt::format("its knowledge base {} is not there any more", path),
                               "Say where it is now with --kb.");
    }
    if (!path.empty()) setup.order.take_knowledge(path);
    if (recorded != nullptr && setup.order.knowledge_checksum != recorded->checksum)
        throw cannot_go_on(setup, " with another knowledge base",
                           fmt::format("{} is not the file it was started with", setup.order.knowledge_path),
                           "Give that one with --kb.");
}

/// A run that was killed before its first checkpoint has none.
void find_checkpoint(RunSetup& setup) {
    std::string const newer = setup.file(run_file::checkpoint), older = setup.file(run_file::older_checkpoint);
    if (!fs::exists(newer) && !fs::exists(older)) return;
    FoundCheckpoint found = read_checkpoint(newer, older);
    setup.warning = std::move(found.warning);
    setup.checkpoint = std::move(found.checkpoint);
}

/// The founders are those that the run was started with, wherever they are now. Once generation 0 is past, the run does
/// not need them.
void find_founders(RunSetup& setup) {
    std::vector<std::string>& from = setup.order.config.founders_from;
    for (std::string& one : from) one = absolute_path(one);
    std::vector<FileRecord> const recorded = with_role(setup.manifest.inputs, file_role::founders);
    bool const is_known = !setup.manifest.sessions.empty();   // else the digest tells
    if (is_known && from.size() != recorded.size())
        throw cannot_go_on(setup, " with other founders",
                           recorded.empty()
                               ? std::string{"it was started with random ones"}
                               : fmt::format("it was started with those of {}", setup.founders_origin()->path),
                           "Set founders.from as it was, or start in another directory.");
    auto const is_at = [](std::string const& one, FileRecord const& record) {   // a run's directory may be gone
        return one == record.path || (fs::path{one} / run_file::lineage).string() == record.path;
    };
    bool const all_are_there = std::equal(from.begin(), from.end(), recorded.begin(), recorded.end(), is_at);
    if (from.empty() || (setup.checkpoint && all_are_there)) return;
    std::vector<FileRecord> now = founders_records(from);
    for (std::size_t i = 0; i < std::min(recorded.size(), now.size()); ++i)
        if (recorded[i].checksum != now[i].checksum)
            throw cannot_go_on(
                setup, " with other founders", fmt::format("{} is not the file it was started with", now[i].path),
                recorded.size() == 1 ? std::string{"Give that one with --founders, or start in another directory."}
                                     : fmt::format("Give those with --founders in the order of the start: {}.",
                                                   setup.founders_origin()->path));
    if (recorded.empty()) setup.manifest.inputs.insert(setup.manifest.inputs.end(), now.begin(), now.end());
    if (!setup.checkpoint) setup.founders_are_due = true;
}

void take_seed(RunSetup& setup, RunOptions const& options) {
    if (!setup.manifest.sessions.empty()) setup.seed = setup.manifest.seed;
    else setup.seed = setup.checkpoint ? setup.checkpoint->seed : options.seed.value_or(1);
    if (options.seed && *options.seed != setup.seed)
        throw cannot_go_on(setup, " with another seed", fmt::format("it was started with --seed {}", setup.seed),
                           "Leave out --seed, or start in another directory.");
}

void choose_archive(RunSetup& setup, RunOptions const& options) {
    bool const archived = setup.checkpoint ? setup.checkpoint->all_individuals.bytes > 0
                                           : fs::exists(setup.file(run_file::all_individuals));
    if (setup.checkpoint && options.archive_all && !archived)
        throw UsageError(fmt::format("cannot archive all individuals of {}", setup.directory),
                         "the run was started without --archive all", "Leave it out, or start in another directory.");
    setup.archive_all = archived || options.archive_all;
}

}   // namespace

void resume(RunSetup& setup, RunOptions const& options) {
    if (std::string const arena = setup.file(run_file::arena); fs::exists(arena))
        setup.order.arena_text = read_text(arena, most_data);
    setup.order.config = configuration_to_go_on_with(setup, options);
    if (fs::exists(setup.file(run_file::manifest))) setup.manifest = read_manifest(setup.file(run_file::manifest));
    find_knowledge(setup, options);
    find_checkpoint(setup);
    take_seed(setup, options);
    find_founders(setup);   // clones of a knowledge base are drawn by the seed
    choose_archive(setup, options);
}

void check_digest(RunSetup& setup) {
    if (setup.checkpoint && setup.checkpoint->seed != setup.seed)
        throw cannot_go_on(setup, "", fmt::format("{} has another seed than its checkpoint", run_file::manifest),
                           "Restore it.");
    // Where the manifest is lost, the checkpoint alone knows the world.
    if (std::string const other = setup.checkpoint ? why_other(setup.checkpoint->world, setup.manifest.world) : "";
        !other.empty())
        throw cannot_go_on(setup, "", other, "Give it the world that it was started with.");
    auto const founders = setup.founders_origin();
    setup.digest = digest_of(setup.order, setup.seed, founders ? founders->checksum : "");
    if (!setup.checkpoint || setup.checkpoint->config_digest == setup.digest) return;
    setup.has_former_digest =
        setup.checkpoint->config_digest ==
        former_digest_of(read_text(setup.file(run_file::config), most_data), setup.order, setup.seed);
    if (!setup.has_former_digest)
        throw cannot_go_on(setup, "",
                           fmt::format("{} or {} was changed since its checkpoint", run_file::config,
                                       setup.order.config.has_world() ? "its world" : run_file::arena),
                           "Restore them.");
}

}   // namespace lore
