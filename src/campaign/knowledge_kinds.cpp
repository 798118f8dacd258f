#include "knowledge_kinds.h"

#include "plan_reading.h"

#include <lore/campaign/choice.h>
#include <lore/core/error.h>
#include <lore/core/toml.h>
#include <lore/experiment/config.h>
#include <lore/world/reward_text.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>

#include <fmt/format.h>

namespace lore {

namespace {

using Words = std::vector<std::string>;

// ---- what each kind reads ----

void read_seed(TomlTable const& table, KnowledgePlan& plan) {
    plan.seed = static_cast<std::uint64_t>(table.integer("seed", 0, most_seed).value_or(1));
}

void read_options(TomlTable const& table, KnowledgePlan& plan) {
    plan.options = table.strings("options").value_or(Words{});
}

/// Windows of its own.
void read_build(TomlTable const& table, KnowledgePlan& plan) {
    read_options(table, plan);
    for (std::string const& option : plan.options)
        if (option.starts_with("--window-length") || option.starts_with("--threshold"))
            table.fail("options", fmt::format("'{}' is for the runs that use the base too", option),
                       "Write window_length = or match_threshold = instead.");
    plan.match_threshold = table.number("match_threshold", 0, 1000);
    if (plan.match_threshold == 0.0) table.fail("match_threshold", "0 matches nothing", "Take a positive number.");
    if (auto const steps = table.integer("window_length", 1, longest_window))
        plan.window_length = static_cast<int>(*steps);
}

/// Of a base from the best robot of a source run.
void read_lineage(TomlTable const& table, KnowledgePlan& plan) {
    plan.source = table.string("source").value_or("");
    read_build(table, plan);
}

void read_counted_reward(TomlTable const& table, KnowledgePlan& plan) {
    plan.wished_reward = table.required_number(first_reward_unit, 0, 1e6);
    read_lineage(table, plan);
}

void read_reward(TomlTable const& table, KnowledgePlan& plan) {
    plan.wished_reward =
        table.required_number("reward", std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max());
    read_lineage(table, plan);
}

void read_run(TomlTable const& table, KnowledgePlan& plan) {
    plan.run = each_run;
    if (!table.is_string("run")) plan.run = static_cast<int>(*table.integer("run", 1, most_runs));
    else if (table.required_string("run") != "each")
        table.fail("run", "a number or \"each\" is expected", "Write run = 3, for example.");
    read_lineage(table, plan);
}

void read_best(TomlTable const& table, KnowledgePlan& plan) {
    plan.source = table.required_string("best_of");
    plan.best_run = true;
    read_build(table, plan);
}

/// As lore-kb revalue takes them.
void read_revaluation(TomlTable const& table, KnowledgePlan& plan) {
    using Real = std::numeric_limits<double>;
    std::string const rule = table.required_string("value");
    auto const gamma = table.number("gamma", Real::lowest(), Real::max());
    auto const success = table.number("success", Real::lowest(), Real::max());
    try {
        plan.value = value_config(rule, gamma, success);
    } catch (UsageError const& error) { table.fail("value", error); }
}

void read_reduction(TomlTable const& table, KnowledgePlan& plan) {
    read_options(table, plan);
    std::string_view const how = only_key(table, {"top", "least_value", "least_count", "consensus"});
    auto const reduce_by = [&](std::string_view option, auto bound) {
        plan.options.insert(plan.options.begin(), {std::string{option}, fmt::format("{}", bound)});
    };
    if (how == "top") reduce_by("--top", *table.integer(how, 1, 100'000'000));
    using Real = std::numeric_limits<double>;
    if (how == "least_value") reduce_by("--min-value", *table.number(how, Real::lowest(), Real::max()));
    if (how == "least_count") reduce_by("--min-count", *table.integer(how, 1, 100'000'000));
    if (how != "consensus") return;
    plan.consensus = *table.strings("consensus");
    if (plan.consensus.empty())
        table.fail("consensus", "it names no base", "Name at least one that must have the features, too.");
}

// ---- what each kind waits for ----

Words after_choice(KnowledgePlan const& knowledge, std::vector<Step>&) { return {choose_step(knowledge.source)}; }

/// The source run is made once more and keeps all individuals.
Words after_archive(KnowledgePlan const& knowledge, std::vector<Step>& steps) {
    std::string const archive = archive_step(knowledge.name);
    steps.push_back({archive, StepKind::archive, archive, knowledge.name, 0, after_choice(knowledge, steps)});
    return {archive};
}

Words after_bases(KnowledgePlan const& knowledge, std::vector<Step>&) {
    Words groups{knowledge_step(knowledge.base)};
    for (std::string const& other : knowledge.consensus) groups.push_back(knowledge_step(other));
    return groups;
}

// ---- how lore-kb makes each kind ----

Words build_lineage(KnowledgePlan const& knowledge, CommandContext const& context) {
    return {"build", source_run_of(knowledge, context)};
}
Words build_same_lineage(KnowledgePlan const& knowledge, CommandContext const& context) {
    return {"build", source_run_of(context.plan.knowledge_base(knowledge.base), context)};
}
Words build_all(KnowledgePlan const& knowledge, CommandContext const& context) {
    return {"build", context.directory.run(archive_step(knowledge.name)), "--all"};
}
Words randomize(KnowledgePlan const& knowledge, CommandContext const& context) {
    return {"randomize", context.directory.knowledge(knowledge.base), "--seed", std::to_string(knowledge.seed)};
}
Words permute(KnowledgePlan const& knowledge, CommandContext const& context) {
    return {"randomize", context.directory.knowledge(knowledge.base), "--permute", "--seed",
            std::to_string(knowledge.seed)};
}
Words revalue(KnowledgePlan const& knowledge, CommandContext const& context) {
    ValueConfig const& value = knowledge.value;
    Words words{"revalue", context.directory.knowledge(knowledge.base), "--value", std::string{name(value.rule)}};
    if (value.rule == ValueRule::discounted_return)
        words.insert(words.end(), {"--gamma", fmt::format("{}", value.gamma)});
    if (value.success_reward) words.insert(words.end(), {"--success", fmt::format("{}", *value.success_reward)});
    return words;
}
Words reduce(KnowledgePlan const& knowledge, CommandContext const& context) {
    Words words{"reduce", context.directory.knowledge(knowledge.base)};
    if (!knowledge.consensus.empty()) words.push_back("--consensus");
    for (std::string const& other : knowledge.consensus) words.push_back(context.directory.knowledge(other));
    return words;
}

constexpr KnowledgeKindRow kinds[] = {
    // key, kind, is built, base has a lineage, reads, waits for, is made by
    {first_reward_unit, KnowledgeKind::lineage, true, false, read_counted_reward, after_choice, build_lineage},
    {"reward", KnowledgeKind::lineage, true, false, read_reward, after_choice, build_lineage},
    {"run", KnowledgeKind::lineage, true, false, read_run, after_choice, build_lineage},
    {"best_of", KnowledgeKind::lineage, true, false, read_best, after_choice, build_lineage},
    {"lineage_of", KnowledgeKind::same_lineage, true, true, read_build, after_choice, build_same_lineage},
    {"all_of", KnowledgeKind::all, true, true, read_build, after_archive, build_all},
    {"random_of", KnowledgeKind::random, false, false, read_seed, after_bases, randomize},
    {"permuted_of", KnowledgeKind::permuted, false, false, read_seed, after_bases, permute},
    {"revalued_of", KnowledgeKind::revalued, false, false, read_revaluation, after_bases, revalue},
    {"part_of", KnowledgeKind::reduced, false, false, read_reduction, after_bases, reduce},
};

}   // namespace

std::span<KnowledgeKindRow const> knowledge_kinds() { return kinds; }

KnowledgeKindRow const& row_of(KnowledgeKind kind) {
    auto const row = std::find_if(std::begin(kinds), std::end(kinds), [&](auto const& r) { return r.kind == kind; });
    assert(row != std::end(kinds));
    return *row;
}

KnowledgePlan read_knowledge(TomlTable const& table) {
    KnowledgePlan plan;
    plan.name = read_name(table);
    plan.label = table.string("label").value_or(plan.name);
    std::vector<std::string_view> keys;
    for (KnowledgeKindRow const& row : kinds) keys.push_back(row.key);
    std::string_view const key = only_key(table, keys);
    KnowledgeKindRow const& row =
        *std::find_if(std::begin(kinds), std::end(kinds), [&](auto const& r) { return r.key == key; });
    plan.kind = row.kind;
    if (row.kind != KnowledgeKind::lineage) plan.base = table.required_string(key);
    row.read(table, plan);
    table.reject_unknown();
    return plan;
}

std::string source_run_of(KnowledgePlan const& lineage, CommandContext const& context) {
    ChosenRun const* const chosen = context.choice == nullptr ? nullptr : context.choice->find(lineage.name);
    return context.directory.run(run_step(lineage.source, chosen == nullptr ? 0 : chosen->run));
}

std::string knowledge_step(std::string_view name) { return fmt::format("knowledge/{}", name); }
std::string archive_step(std::string_view name) { return fmt::format("archive/{}", name); }

}   // namespace lore
