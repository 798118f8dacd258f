#include "treatment_inputs.h"

#include "plan_reading.h"

#include <lore/core/error.h>
#include <lore/experiment/config.h>
#include <lore/experiment/run_directory.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

// ---- knowledge = "kb1": a base for the reward ----

/// What `lore-kb build` will cut the windows of a base by: its own keys, else what its source run was configured with.
KnowledgeConfig windows_of(CampaignPlan const& plan, KnowledgePlan const& knowledge) {
    KnowledgePlan const& built = built_base(plan, knowledge);
    Treatment const& source = plan.treatment(knowledge.source);
    KnowledgeConfig config = read_config(plan.config_path(source), source.overrides).knowledge;
    config.window_length = built.window_length.value_or(config.window_length);
    if (built.match_threshold) config.match_threshold = static_cast<float>(*built.match_threshold);
    return config;
}

/// Has a treatment's runs read the windows of its base, unless its configuration does so already.
void fit_windows(TomlTable const& table, std::string const& config_path, Treatment& treatment,
                 KnowledgeConfig const& base) {
    if (read_windows(table, config_path, {}) != base)
        treatment.overrides.insert(treatment.overrides.begin(),
                                   {fmt::format("knowledge.window_length={}", base.window_length),
                                    fmt::format("knowledge.match_threshold={}", base.match_threshold)});
    KnowledgeConfig const read = read_windows(table, config_path, treatment.overrides);
    if (read != base)
        table.fail("set",
                   fmt::format("it asks for windows of {} steps and threshold {}, and '{}' has {} and {}",
                               read.window_length, read.match_threshold, treatment.knowledge[0], base.window_length,
                               base.match_threshold),
                   "Leave them out: a treatment takes those of its base.");
}

void fit_knowledge(TomlTable const& table, CampaignPlan const& plan, Treatment& treatment) {
    if (treatment.knowledge.size() > 1)
        table.fail("knowledge", fmt::format("one base shapes the reward, and it names {}", treatment.knowledge.size()),
                   "Name one.");
    require_known(table, "knowledge", treatment.knowledge[0], names_of(plan.knowledge));
    fit_windows(table, plan.config_path(treatment), treatment,
                windows_of(plan, plan.knowledge_base(treatment.knowledge[0])));
}

std::vector<std::string> after_knowledge(CampaignPlan const&, Treatment const& treatment, std::vector<Step>&) {
    return {knowledge_step(treatment.knowledge[0])};
}

std::vector<std::string> knowledge_arguments(Treatment const& treatment, CommandContext const& context) {
    return {"--kb", context.directory.knowledge(treatment.knowledge[0])};
}

// ---- clone_of = "kb1", policy_of = ["kb1", "kb2"]: founders ----

void require_each(TomlTable const& table, std::string_view key, NameList const& names, NameList const& known) {
    for (std::string const& name : names) {
        require_known(table, key, name, known);
        if (std::count(names.begin(), names.end(), name) > 1)
            table.fail(key, fmt::format("it names '{}' twice", name), "Name each once.");
    }
}

/// "--founders A B ...", of each name what `place` says.
std::vector<std::string> founders_arguments(NameList const& names, auto const& place) {
    std::vector<std::string> words{"--founders"};
    for (std::string const& name : names) words.push_back(place(name));
    return words;
}

void fit_clone(TomlTable const& table, CampaignPlan const& plan, Treatment& treatment) {
    require_each(table, "clone_of", treatment.clone_of, names_of(plan.knowledge));
}
std::vector<std::string> after_clone(CampaignPlan const&, Treatment const& treatment, std::vector<Step>&) {
    NameList groups;
    for (std::string const& name : treatment.clone_of) groups.push_back(knowledge_step(name));
    return groups;
}
std::vector<std::string> clone_arguments(Treatment const& treatment, CommandContext const& context) {
    return founders_arguments(treatment.clone_of,
                              [&](std::string const& name) { return context.directory.knowledge(name); });
}

void fit_policy(TomlTable const& table, CampaignPlan const& plan, Treatment& treatment) {
    require_each(table, "policy_of", treatment.policy_of, names_of(plan.knowledge));
    for (std::string const& name : treatment.policy_of)
        if (plan.knowledge_base(name).kind != KnowledgeKind::lineage)
            table.fail("policy_of", fmt::format("'{}' is made from another base", name),
                       "Name bases with 'balls', 'reward', 'run' or 'best_of': of source runs.");
    if (!treatment.clone_of.empty())
        table.fail("policy_of", "founders come from one place, and there is clone_of", "Leave one of the two out.");
}
std::vector<std::string> after_policy(CampaignPlan const& plan, Treatment const& treatment, std::vector<Step>&) {
    NameList groups;
    for (std::string const& name : treatment.policy_of) {
        std::string group = choose_step(plan.knowledge_base(name).source);
        if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(std::move(group));
    }
    return groups;
}
std::vector<std::string> policy_arguments(Treatment const& treatment, CommandContext const& context) {
    return founders_arguments(treatment.policy_of, [&](std::string const& name) {
        return source_run_of(context.plan.knowledge_base(name), context);
    });
}

/// Whether a file of a manifest is the one that a run was to read, or lies in the run whose founders it was to take.
bool is_same(std::filesystem::path read, std::filesystem::path const& wanted) {
    if (read.filename() == run_file::lineage) read = read.parent_path();
    return read.filename() == wanted.filename() && read.parent_path().filename() == wanted.parent_path().filename();
}

constexpr TreatmentInput inputs[] = {
    {"knowledge", "shaping", &Treatment::knowledge, fit_knowledge, after_knowledge, knowledge_arguments,
     file_role::knowledge},
    {"clone_of", "clone", &Treatment::clone_of, fit_clone, after_clone, clone_arguments, file_role::founders},
    {"policy_of", "policy", &Treatment::policy_of, fit_policy, after_policy, policy_arguments, file_role::founders},
};

}   // namespace

std::span<TreatmentInput const> treatment_inputs() { return inputs; }

std::string other_inputs(Treatment const& treatment, CommandContext const& context,
                         std::vector<std::string> const& founders_from, Manifest const& manifest) {
    for (std::string_view const role : {file_role::knowledge, file_role::founders}) {
        std::vector<FileRecord> const read = with_role(manifest.inputs, role);
        auto const wanted = std::find_if(std::begin(inputs), std::end(inputs), [&](TreatmentInput const& input) {
            return input.role == role && !(treatment.*input.names).empty();
        });
        if (wanted == std::end(inputs)) {
            bool const from_elsewhere = role == file_role::founders && !founders_from.empty();
            if (!read.empty() && !from_elsewhere) return fmt::format("with {} as {}", read[0].path, role);
            continue;
        }
        NameList const& names = treatment.*wanted->names;
        if (read.size() != names.size())
            return fmt::format("{} {} = {}", read.empty() ? "without" : "not with", wanted->key,
                               fmt::join(names, ", "));
        NameList const arguments = wanted->arguments(treatment, context);
        for (std::size_t i = 0; i < names.size(); ++i) {
            std::filesystem::path const path = arguments[i + 1];
            bool const not_chosen = path.filename() == "?";   // the choice was lost, and will be made again
            if (!not_chosen && !is_same(read[i].path, path))
                return fmt::format("with {}, not with {} = {}", read[i].path, wanted->key, names[i]);
        }
    }
    return "";
}

void add_treatment(TomlTable const& table, Treatment treatment, CampaignPlan& plan) {
    std::vector<std::string> names{"source"};
    for (Treatment const& source : plan.sources) names.push_back(source.name);
    for (Treatment const& target : plan.targets) names.push_back(target.name);
    require_new(table, treatment.name, names);
    read_windows(table, plan.config_path(treatment), treatment.overrides);
    NameList const known = plan.base_names();
    for (TreatmentInput const& input : treatment_inputs()) {
        for (std::string const& name : treatment.*input.names) require_known(table, input.key, name, known);
        treatment.*input.names = plan.members(treatment.*input.names);
    }
    for (TreatmentInput const& input : treatment_inputs())
        if (!(treatment.*input.names).empty()) input.fit(table, plan, treatment);
    plan.targets.push_back(std::move(treatment));
}

KnowledgeConfig read_windows(TomlTable const& table, std::string const& config_path,
                             std::vector<std::string> const& overrides) {
    try {
        return read_config(config_path, overrides).knowledge;
    } catch (Error const& error) { table.fail(table.has("set") ? "set" : "config", error); }
}

}   // namespace lore
