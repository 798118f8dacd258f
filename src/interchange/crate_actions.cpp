#include "crate.h"

#include <lore/archive/knowledge_file.h>
#include <lore/campaign/choice.h>
#include <lore/campaign/state.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/run_directory.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

constexpr char license_of_lore[] = "https://spdx.org/licenses/BSD-3-Clause";

/// Programs of one build each, which many actions share.
class Software {
public:
    explicit Software(std::vector<Json>& entities) : entities_(entities) {}

    /// Id of lore-evolve as that build.
    std::string evolve(BuildInformation const& build) {
        std::string key = "lore-evolve " + build.version + build.commit + build.compiler + build.build_type;
        for (auto const& [library, version] : build.libraries) key += "\n" + library + " " + version;
        return id_of(key, "lore-evolve", build.version + "+" + build.commit,
                     fmt::format("commit {}, compiled by {}, {}", build.commit, build.compiler, build.build_type),
                     build.libraries);
    }

    /// Id of lore-kb; `made_by` ends with "(Lore VERSION, commit COMMIT)".
    std::string knowledge(std::string const& made_by) {
        constexpr std::string_view mark = "(Lore ", comma = ", commit ";
        std::size_t const at = made_by.rfind(mark), middle = made_by.find(comma, at);
        if (at == std::string::npos || middle == std::string::npos || !made_by.ends_with(')'))
            return id_of("lore-kb", "lore-kb", "unknown", made_by, {});
        std::string const version = made_by.substr(at + mark.size(), middle - at - mark.size());
        std::string const commit = made_by.substr(middle + comma.size(), made_by.size() - 1 - middle - comma.size());
        return id_of("lore-kb " + version + commit, "lore-kb", version + "+" + commit, fmt::format("commit {}", commit),
                     {});
    }

private:
    using Libraries = std::vector<std::pair<std::string, std::string>>;

    std::string id_of(std::string const& key, std::string const& program, std::string const& version,
                      std::string const& description, Libraries const& libraries) {
        for (auto const& [known, id] : ids_)
            if (known == key) return id;
        auto const same = std::count_if(ids_.begin(), ids_.end(),
                                        [&](auto const& known) { return known.first.starts_with(program); });
        std::string const id = same == 0 ? "#" + program : fmt::format("#{}-{}", program, same + 1);
        Json entity{{"@id", id},
                    {"@type", "SoftwareApplication"},
                    {"name", program},
                    {"softwareVersion", version},
                    {"description", description},
                    {"license", reference_to(license_of_lore)}};
        if (!libraries.empty()) entity["softwareRequirements"] = Json::array();
        for (auto const& [library, of] : libraries)
            entity["softwareRequirements"].push_back(reference_to(library_id(library, of)));
        entities_.push_back(std::move(entity));
        ids_.emplace_back(key, id);
        return id;
    }

    std::string library_id(std::string const& library, std::string const& version) {
        std::string const id = "#library/" + entity_id(library + "-" + version);
        for (auto const& [known, ignored] : ids_)
            if (known == id) return id;
        entities_.push_back(
            {{"@id", id}, {"@type", "SoftwareApplication"}, {"name", library}, {"softwareVersion", version}});
        ids_.emplace_back(id, id);
        return id;
    }

    std::vector<Json>& entities_;
    std::vector<std::pair<std::string, std::string>> ids_;   ///< by what tells one from another
};

/// What all actions of a pack are made from.
struct Story {
    CampaignPlan const& plan;
    CampaignPlan moved;   ///< as it lies in the pack
    CampaignDirectory const& directory;
    Inventory const& inventory;
    Json agents;
    std::optional<Choice> choice;
    CrateActions& told;
    Software software;
    std::map<std::string, std::vector<std::string>> worlds;   ///< places of their files, by treatment

    bool has(std::vector<PackedFile> const& files, std::string_view path) const {
        return std::any_of(files.begin(), files.end(), [&](PackedFile const& file) { return file.path == path; });
    }
    /// Adds a reference to the file, if the pack knows it.
    void add_file(Json& list, std::string const& path) const {
        if (has(inventory.files, path)) list.push_back(reference_to(entity_id(path)));
        else if (has(inventory.left_out, path)) list.push_back(reference_to(left_out_id(path)));
    }
    void add_value(Json& list, std::string const& action, std::string const& name, std::string const& value) {
        std::string const id = fmt::format("{}/{}", action, name);
        told.entities.push_back({{"@id", id}, {"@type", "PropertyValue"}, {"name", name}, {"value", value}});
        list.push_back(reference_to(id));
    }
    /// As one would type it in the unpacked pack.
    std::string command(Step const& step) const {
        return shell_text(command_of(moved, CampaignDirectory{"."}, Launcher{}, step, choice ? &*choice : nullptr));
    }
    /// The folder of the source run that a base made from a lineage comes from.
    void add_source_run(Json& list, std::string const& knowledge) const {
        ChosenRun const* const chosen = choice ? choice->find(knowledge) : nullptr;
        if (chosen != nullptr)
            list.push_back(reference_to(
                entity_id(fmt::format("runs/{}/", run_step(plan.knowledge_base(knowledge).source, chosen->run)))));
    }
    void add_action(Json action) {
        if (!agents.empty()) action["agent"] = agents;
        told.ids.push_back(action.at("@id"));
        told.entities.push_back(std::move(action));
    }
};

std::string knowledge_path(std::string const& name) { return fmt::format("knowledge/{}.lorekb", name); }

Json inputs_of_run(Story& story, Step const& step, std::string const& id, Manifest const& manifest) {
    Json inputs = Json::array();
    bool const again = step.kind == StepKind::archive;
    Treatment const& treatment =
        story.plan.treatment(again ? story.plan.knowledge_base(step.subject).source : step.subject);
    story.add_file(inputs, story.moved.config_path(treatment));
    if (auto const world = story.worlds.find(treatment.name); world != story.worlds.end())
        for (std::string const& place : world->second) story.add_file(inputs, place);
    for (auto const* const bases : {&treatment.knowledge, &treatment.clone_of})
        for (std::string const& base : *bases) story.add_file(inputs, knowledge_path(base));
    for (std::string const& base : treatment.policy_of) story.add_source_run(inputs, base);
    story.add_value(inputs, id, "seed", std::to_string(manifest.seed));
    return inputs;
}

/// "...+00:00" for "...Z": both are ISO 8601, and some validators know the first alone.
std::string with_offset(std::string const& time) {
    return time.ends_with('Z') ? time.substr(0, time.size() - 1) + "+00:00" : time;
}

void tell_run(Story& story, Step const& step) {
    std::string const folder = fmt::format("runs/{}/", step.name);
    if (!story.has(story.inventory.files, folder + run_file::manifest)) return;
    Manifest const manifest = read_manifest((fs::path{story.directory.run(step.name)} / run_file::manifest).string());
    bool const done = manifest.status == RunStatus::done;
    if (step.kind == StepKind::evolve) {
        ++story.told.runs;
        story.told.finished += done;
    }
    std::string const id = "#run/" + step.name;
    Json action{
        {"@id", id}, {"@type", "CreateAction"}, {"name", "Run " + step.name}, {"description", story.command(step)}};
    if (!manifest.sessions.empty()) {
        action["startTime"] = with_offset(manifest.sessions.front().started);
        std::string const& stopped = manifest.sessions.back().stopped;
        if (!stopped.empty()) action["endTime"] = with_offset(stopped);
        story.told.last_day = std::max(story.told.last_day, stopped.substr(0, 10));
    }
    action["instrument"] = reference_to(story.software.evolve(manifest.build));
    action["object"] = inputs_of_run(story, step, id, manifest);
    Json results = Json::array({reference_to(entity_id(folder))});
    if (!manifest.signature.empty()) story.add_value(results, id, "signature", manifest.signature);
    action["result"] = results;
    action["actionStatus"] =
        reference_to(done ? "http://schema.org/CompletedActionStatus" : "http://schema.org/FailedActionStatus");
    if (!done)
        action["error"] = fmt::format("stopped at generation {} of {}; it can go on from its checkpoint",
                                      manifest.generation, manifest.generations);
    story.add_action(std::move(action));
}

void tell_base(Story& story, Step const& step) {
    std::string const path = knowledge_path(step.subject);
    Json results = Json::array();
    story.add_file(results, path);
    if (results.empty()) return;
    ++story.told.bases;
    KnowledgePlan const& planned = story.plan.knowledge_base(step.subject);
    Json inputs = Json::array();
    switch (planned.kind) {
    case KnowledgeKind::lineage: story.add_source_run(inputs, planned.name); break;
    case KnowledgeKind::same_lineage: story.add_source_run(inputs, planned.base); break;
    case KnowledgeKind::all:
        inputs.push_back(reference_to(entity_id(fmt::format("runs/archive/{}/", planned.name))));
        break;
    default: story.add_file(inputs, knowledge_path(planned.base));
    }
    for (std::string const& other : planned.consensus) story.add_file(inputs, knowledge_path(other));
    KnowledgeBase const base = read_knowledge_base(story.directory.knowledge(step.subject));
    Json action{{"@id", "#base/" + planned.name},
                {"@type", "CreateAction"},
                {"name", "Knowledge base " + planned.name},
                {"description", story.command(step)},
                {"instrument", reference_to(story.software.knowledge(base.provenance().made_by))}};
    if (!inputs.empty()) action["object"] = inputs;
    action["result"] = results;
    action["actionStatus"] = reference_to("http://schema.org/CompletedActionStatus");
    story.add_action(std::move(action));
}

}   // namespace

CrateActions crate_actions(CampaignPlan const& plan, CampaignDirectory const& directory, Inventory const& inventory,
                           std::vector<std::string> const& agents) {
    CrateActions told;
    Json by = Json::array();
    for (std::string const& agent : agents) by.push_back(reference_to(agent));
    auto choice = recorded_choices(plan, directory);
    if (choice && !choice->covers(plan)) choice.reset();
    Story story{plan,
                plan_in_pack(plan),
                directory,
                inventory,
                by,
                choice,
                told,
                Software{told.entities},
                places_of_worlds(plan)};
    for (Step const& step : steps_of(plan)) {
        if (step.kind == StepKind::evolve || step.kind == StepKind::archive) tell_run(story, step);
        if (step.kind == StepKind::build) tell_base(story, step);
    }
    if (told.runs > 0)
        told.entities.push_back({{"@id", license_of_lore},
                                 {"@type", "CreativeWork"},
                                 {"name", "BSD-3-Clause"},
                                 {"description", "License of Lore"},
                                 {"url", license_of_lore}});
    return told;
}

}   // namespace lore
