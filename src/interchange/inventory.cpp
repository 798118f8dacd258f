#include "inventory.h"

#include <lore/core/directory.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/names.h>
#include <lore/core/utf8.h>
#include <lore/experiment/config.h>
#include <lore/experiment/run_directory.h>
#include <lore/experiment/run_world.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

constexpr auto part_names = names_for<PackPart>("individuals", "checkpoints", "bases", "logs");

std::string_view file_name(std::string_view path) { return path.substr(path.rfind('/') + 1); }

/// A file that the campaign is made from.
struct Input {
    std::string source;     ///< where it is read
    fs::path place;         ///< where the campaign looks for it; then, in the pack
    std::string world_of;   ///< the treatment whose world it belongs to, if any
};

Input input_of(fs::path const& source, fs::path const& place, std::string const& world_of) {
    return {fs::absolute(source).lexically_normal().string(), fs::absolute(place).lexically_normal(), world_of};
}

void add_world(ExperimentConfig const& config, std::string const& treatment, std::vector<Input>& inputs) {
    WorldRequest const& world = config.world;
    // A library without a folder is looked for beside the configuration before anywhere else.
    bool const searched = !world.name.empty() && world.name.find('/') == std::string::npos;
    // An interpreter by its absolute path is the machine's.
    bool const has_interpreter = !world.process.empty() && fs::path{world.process[0]}.is_absolute();
    for (fs::path const file : world_files(config)) {
        if (has_interpreter && file == world.process[0]) continue;
        inputs.push_back(input_of(file, searched ? fs::path{world.folder} / file.filename() : file, treatment));
    }
}

std::vector<Input> inputs_of(CampaignPlan const& plan) {
    std::vector<Input> inputs{input_of(plan.path, plan.path, "")};
    std::vector<Treatment> treatments = plan.sources;
    treatments.insert(treatments.end(), plan.tasks.begin(), plan.tasks.end());   // [transfer] opens them all
    treatments.insert(treatments.end(), plan.targets.begin(), plan.targets.end());
    for (Treatment const& treatment : treatments) {
        std::string const path = plan.config_path(treatment);
        inputs.push_back(input_of(path, path, ""));
        add_world(read_config(path, treatment.overrides), treatment.name, inputs);
    }
    fs::path root = inputs.front().place.parent_path();
    for (Input const& input : inputs)
        while (input.place.lexically_relative(root).generic_string().starts_with("..")) root = root.parent_path();
    for (Input& input : inputs)
        input.place = std::string{inputs_folder} + input.place.lexically_relative(root).generic_string();
    return inputs;
}

bool is_executable(std::string const& path) {
    std::error_code failed;
    fs::perms const permissions = fs::status(path, failed).permissions();
    if (failed) throw file_error("read", path, failed.value());
    return (permissions & fs::perms::owner_exec) != fs::perms::none;
}

void add_summed(std::string place, std::string const& source, std::vector<PackPart> const& leave_out,
                BetweenPieces const& between, Inventory& inventory) {
    if (!is_safe_path(place))
        throw Error(fmt::format("cannot pack {}", source), "its name has control characters or is no UTF-8",
                    "Rename it.");
    FileSum const sum = read_in_pieces(source, between);
    auto const part = part_of(place);
    bool const left_out = part && std::find(leave_out.begin(), leave_out.end(), *part) != leave_out.end();
    (left_out ? inventory.left_out : inventory.files).push_back({std::move(place), source, sum.bytes, sum.sha256});
}

}   // namespace

std::string_view name(PackPart part) { return part_names[part]; }

PackPart pack_part(std::string_view name) { return part_names.choice(name, "a part that can be left out"); }

bool is_safe_path(std::string_view path) {
    if (!is_printable(path)) return false;
    for (std::string_view rest = path;; rest.remove_prefix(rest.find('/') + 1)) {
        std::string_view const step = rest.substr(0, rest.find('/'));
        if (step.empty() || step == "." || step == "..") return false;
        if (step.size() == rest.size()) return true;
    }
}

bool is_transient(std::string_view path) {
    bool const lock = file_name(path) == run_file::lock || (path.starts_with("steps/") && path.ends_with(".lock"));
    return lock || file_name(path).find(".lore-tmp-") != std::string_view::npos;
}

std::optional<PackPart> part_of(std::string_view path) {
    if (file_name(path) == run_file::all_individuals) return PackPart::individuals;
    if (file_name(path) == run_file::checkpoint || file_name(path) == run_file::older_checkpoint)
        return PackPart::checkpoints;
    if (path.starts_with("knowledge/") && path.ends_with(".lorekb")) return PackPart::bases;
    if (path.starts_with("logs/")) return PackPart::logs;
    return std::nullopt;
}

Inventory take_inventory(CampaignPlan const& plan, CampaignDirectory const& directory,
                         std::vector<PackPart> const& leave_out, BetweenPieces const& between) {
    Inventory inventory;
    for (DirectoryEntry const& entry : entries_below(directory.path())) {
        std::string place = fs::path{entry.path}.lexically_relative(directory.path()).generic_string();
        if (place == crate_file || place == sums_file || (place + "/").starts_with(inputs_folder)) continue;
        if (is_transient(place)) continue;
        if (entry.type == fs::file_type::symlink)
            throw Error(fmt::format("cannot pack {}", entry.path), "it is a link, and an archive holds files",
                        "Put the file in its place.");
        if (entry.type == fs::file_type::directory) continue;
        if (entry.type != fs::file_type::regular)
            throw Error(fmt::format("cannot pack {}", entry.path), "it is no regular file", "Remove it.");
        add_summed(std::move(place), entry.path, leave_out, between, inventory);
    }
    std::map<std::string, std::string> inputs;   // by place: many treatments share them
    for (Input const& input : inputs_of(plan)) inputs[input.place.string()] = input.source;
    for (auto const& [place, source] : inputs) {
        add_summed(place, source, {}, between, inventory);
        inventory.files.back().executable = is_executable(source);
    }
    for (std::vector<PackedFile>* list : {&inventory.files, &inventory.left_out})
        std::sort(list->begin(), list->end(), [](PackedFile const& a, PackedFile const& b) { return a.path < b.path; });
    return inventory;
}

CampaignPlan plan_in_pack(CampaignPlan const& plan) {
    CampaignPlan moved = plan;
    std::string const own = fs::absolute(plan.path).lexically_normal().string();
    for (Input const& input : inputs_of(plan))
        if (input.source == own) moved.path = input.place.string();
    moved.directory = fs::path{moved.path}.parent_path().string();
    return moved;
}

std::map<std::string, std::vector<std::string>> places_of_worlds(CampaignPlan const& plan) {
    std::map<std::string, std::vector<std::string>> places;
    for (Input const& input : inputs_of(plan))
        if (!input.world_of.empty()) places[input.world_of].push_back(input.place.string());
    return places;
}

std::string sums_text(std::vector<PackedFile> const& files) {
    std::string text;
    for (PackedFile const& file : files) text += fmt::format("{}  {}\n", file.sha256, file.path);
    return text;
}

}   // namespace lore
