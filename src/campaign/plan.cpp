#include <lore/campaign/plan.h>

#include "knowledge_tables.h"
#include "plan_reading.h"
#include "transfer.h"
#include "treatment_inputs.h"

#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/toml.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <set>

#include <fmt/format.h>

namespace lore {

namespace {

// Steps of other kinds than runs have names that start with these words.
std::set<std::string, std::less<>> const reserved_names{"choose", "knowledge", "archive", "replay", "report"};

/// Values that treatments share unless they have their own.
struct Defaults {
    std::int64_t runs = 30;
    std::int64_t first_seed = 1;
    std::int64_t generations = 0;   ///< 0: as the configuration says
};

Defaults read_defaults(TomlTable const& document) {
    Defaults defaults;
    defaults.runs = document.integer("runs", 1, most_runs).value_or(defaults.runs);
    defaults.first_seed = document.integer("first_seed", 0, most_seed).value_or(defaults.first_seed);
    defaults.generations = document.integer("generations", 1, most_generations).value_or(0);
    return defaults;
}

/// All keys but `name` and `config`. Nothing that it names is looked at.
Treatment read_inputs(TomlTable const& table, Defaults const& defaults, std::string name) {
    Treatment treatment;
    treatment.name = std::move(name);
    treatment.label = table.string("label").value_or(treatment.name);
    for (TreatmentInput const& input : treatment_inputs()) {
        treatment.*input.names = table.one_or_more(input.key).value_or(NameList{});
        if (table.is_array(input.key) && (treatment.*input.names).empty())
            table.fail(input.key, "the list is empty", "Name one at least, or leave it out.");
    }
    treatment.runs = static_cast<int>(table.integer("runs", 0, most_runs).value_or(defaults.runs));
    treatment.first_seed =
        static_cast<std::uint64_t>(table.integer("first_seed", 0, most_seed).value_or(defaults.first_seed));
    std::int64_t const generations = table.integer("generations", 1, most_generations).value_or(defaults.generations);
    if (generations != 0) treatment.overrides.push_back(fmt::format("evolution.generations={}", generations));
    for (std::string& setting : table.strings("set").value_or(NameList{}))
        treatment.overrides.push_back(std::move(setting));
    table.reject_unknown();
    return treatment;
}

/// All keys but `name`.
Treatment read_treatment(TomlTable const& table, Defaults const& defaults, std::string name) {
    std::string config = table.required_string("config");
    Treatment treatment = read_inputs(table, defaults, std::move(name));
    treatment.config = std::move(config);
    return treatment;
}

// ---- the tables of the file: one function each ----

/// Of runs that begin with nothing.
void refuse_inputs(TomlTable const& table, Treatment const& treatment, std::string_view what) {
    for (TreatmentInput const& input : treatment_inputs())
        if (!(treatment.*input.names).empty())
            table.fail(input.key, fmt::format("the {} takes nothing from other steps", what), "Remove it.");
}

void refuse_reserved(TomlTable const& table, std::string const& name) {
    if (reserved_names.contains(name)) table.fail("name", fmt::format("'{}' is reserved", name), "Choose another.");
}

void read_source(TomlTable const& table, Defaults const& defaults, std::string name, CampaignPlan& plan) {
    Treatment source = read_treatment(table, defaults, std::move(name));
    refuse_inputs(table, source, "source treatment");
    read_windows(table, plan.config_path(source), source.overrides);
    plan.sources.push_back(std::move(source));
}

/// One table [source], whose runs are called that, or several [[source]] with names.
void read_sources(TomlTable const& document, Defaults const& defaults, CampaignPlan& plan) {
    if (!document.is_array("source")) {
        read_source(document.required_table("source"), defaults, "source", plan);
        return;
    }
    for (TomlTable const& table : document.tables("source")) {
        std::string name = read_name(table);
        refuse_reserved(table, name);
        require_new(table, name, names_of(plan.sources));
        read_source(table, defaults, std::move(name), plan);
    }
    if (plan.sources.empty()) document.fail("source", "there is none", "Add a table [[source]].");
}

void read_tasks(TomlTable const& document, Defaults const& defaults, CampaignPlan& plan) {
    for (TomlTable const& table : document.tables("target")) {
        std::string name = read_name(table);
        require_new(table, name, names_of(plan.tasks));
        Treatment task = read_treatment(table, defaults, std::move(name));
        refuse_inputs(table, task, "target task");
        read_windows(table, plan.config_path(task), task.overrides);
        task.target = task.name;
        plan.tasks.push_back(std::move(task));
    }
}

/// A treatment of a named target task has what the task says, unless it has its own.
Treatment read_target_treatment(TomlTable const& table, std::string name, CampaignPlan const& plan) {
    only_key(table, {"target", "config"});
    std::string const target = table.required_string("target");
    require_known(table, "target", target, names_of(plan.tasks));
    Treatment const& task = plan.task(target);
    Treatment treatment =
        read_inputs(table, {task.runs, static_cast<std::int64_t>(task.first_seed), 0}, std::move(name));
    treatment.config = task.config;
    treatment.target = task.name;
    treatment.overrides.insert(treatment.overrides.begin(), task.overrides.begin(), task.overrides.end());
    return treatment;
}

void read_treatments(TomlTable const& document, Defaults const& defaults, CampaignPlan& plan) {
    for (TomlTable const& table : document.tables("treatment")) {
        std::string name = read_name(table);
        refuse_reserved(table, name);
        Treatment treatment = table.has("target") ? read_target_treatment(table, std::move(name), plan)
                                                  : read_treatment(table, defaults, std::move(name));
        add_treatment(table, std::move(treatment), plan);
    }
}

void check_against(TomlTable const& table, PoolPlan const& pool, CampaignPlan const& plan) {
    for (std::string const& other : pool.against) {
        PoolPlan const* const of_others = plan.pool(other);
        NameList const others = of_others == nullptr ? NameList{other} : of_others->treatments;
        for (std::string const& name : others)
            if (std::find(pool.treatments.begin(), pool.treatments.end(), name) != pool.treatments.end())
                table.fail("against", fmt::format("'{}' would be compared with itself", name),
                           "Name other treatments.");
    }
}

void read_pools(TomlTable const& document, CampaignPlan& plan) {
    NameList const treatments = names_of(plan.targets);
    NameList comparable = treatments, names = treatments;
    for (Treatment const& source : plan.sources) names.push_back(source.name);
    for (TomlTable const& table : document.tables("pool")) {
        PoolPlan pool;
        pool.name = read_name(table);
        require_new(table, pool.name, names);
        pool.label = table.string("label").value_or(pool.name);
        pool.treatments = table.strings("treatments").value_or(NameList{});
        for (std::string const& name : pool.treatments) require_known(table, "treatments", name, treatments);
        std::set<std::string> const different(pool.treatments.begin(), pool.treatments.end());
        if (different.empty() || different.size() != pool.treatments.size())
            table.fail("treatments", "it must name one treatment or more, each once");
        pool.against = table.strings("against").value_or(NameList{});
        for (std::string const& name : pool.against) require_known(table, "against", name, comparable);
        if (std::set<std::string>(pool.against.begin(), pool.against.end()).size() != pool.against.size())
            table.fail("against", "it names one twice", "Name each once.");
        check_against(table, pool, plan);
        table.reject_unknown();
        names.push_back(pool.name);
        comparable.push_back(pool.name);
        plan.pools.push_back(std::move(pool));
    }
}

/// A target task without treatments would be a mistake that shows nowhere.
void refuse_idle_tasks(TomlTable const& document, CampaignPlan const& plan) {
    for (Treatment const& task : plan.tasks)
        if (std::none_of(plan.targets.begin(), plan.targets.end(),
                         [&](Treatment const& treatment) { return treatment.target == task.name; }))
            document.fail("target", fmt::format("no treatment has the target task '{}'", task.name),
                          "Name it in a treatment, or add a table [transfer].");
}

NameList read_order(TomlTable const& table, NameList const& treatments) {
    auto order = table.strings("order");
    if (!order) return treatments;
    for (std::string const& name : *order) require_known(table, "order", name, treatments);
    if (std::set<std::string>(order->begin(), order->end()).size() != treatments.size() ||
        order->size() != treatments.size())
        table.fail("order", "it must name every treatment once");
    return *std::move(order);
}

void refuse_twice(TomlTable const& table, std::string_view key, NameList const& names) {
    for (std::string const& name : names)
        if (std::count(names.begin(), names.end(), name) > 1)
            table.fail(key, fmt::format("it names '{}' twice", name), "Name each once.");
}

NameList read_shown(TomlTable const& table, CampaignPlan const& plan) {
    NameList known = plan.report_order;
    for (PoolPlan const& pool : plan.pools) known.push_back(pool.name);
    NameList const names = table.strings("figure3").value_or(NameList{});
    for (std::string const& name : names) {
        require_known(table, "figure3", name, known);
        if (PoolPlan const* const pool = plan.pool(name))
            for (std::string const& treatment : pool->treatments)
                if (plan.treatment(treatment).target != plan.treatment(pool->treatments.front()).target)
                    table.fail("figure3", fmt::format("'{}' pools treatments of several target tasks", name),
                               "Name pools of one task, or treatments.");
    }
    refuse_twice(table, "figure3", names);
    return names;
}

FigurePlan read_figures(TomlTable const& table, CampaignPlan const& plan) {
    NameList const bases = names_of(plan.knowledge);
    FigurePlan figures;
    figures.figure3 = read_shown(table, plan);
    figures.trajectory = table.string("trajectory").value_or("");
    figures.figure5 = table.strings("figure5").value_or(NameList{});
    figures.figure6 = table.strings("figure6").value_or(NameList{});
    if (!figures.trajectory.empty()) {
        require_known(table, "trajectory", figures.trajectory, bases);
        if (plan.knowledge_base(figures.trajectory).kind != KnowledgeKind::lineage)
            table.fail("trajectory", "it must name a knowledge base made from a lineage");
    }
    for (std::string const& name : figures.figure5) require_known(table, "figure5", name, bases);
    for (std::string const& name : figures.figure6) require_known(table, "figure6", name, bases);
    refuse_twice(table, "figure5", figures.figure5);
    return figures;
}

std::vector<double> read_levels(TomlTable const& table) {
    constexpr std::size_t most_levels = 9;
    auto levels = table.numbers("levels").value_or(std::vector<double>{});
    if (levels.size() > most_levels) table.fail("levels", fmt::format("there are more than {}", most_levels));
    if (!std::is_sorted(levels.begin(), levels.end(), std::less_equal<>{}))
        table.fail("levels", "they must increase", "Sort them, each once.");
    return levels;
}

void read_report(TomlTable const& document, CampaignPlan& plan) {
    plan.report_order = names_of(plan.targets);
    auto const table = document.table("report");
    if (!table) return;
    plan.report_order = read_order(*table, plan.report_order);
    plan.levels = read_levels(*table);
    plan.figures = read_figures(*table, plan);
    table->reject_unknown();
}

void read_cluster(TomlTable const& document, CampaignPlan& plan) {
    auto const table = document.table("cluster");
    if (!table) return;
    ClusterPlan& cluster = plan.cluster;
    cluster.time_limit = table->string("time_limit").value_or(cluster.time_limit);
    cluster.warning_seconds =
        static_cast<int>(table->integer("warning_seconds", 1, 3600).value_or(cluster.warning_seconds));
    cluster.concurrent = static_cast<int>(table->integer("concurrent", 1, 100'000).value_or(cluster.concurrent));
    cluster.options = table->strings("options").value_or(NameList{});
    table->reject_unknown();
}

Treatment const& named(std::vector<Treatment> const& treatments, std::string_view name) {
    auto const found =
        std::find_if(treatments.begin(), treatments.end(), [&](Treatment const& t) { return t.name == name; });
    assert(found != treatments.end());
    return *found;
}

}   // namespace

bool CampaignPlan::is_source(std::string_view treatment) const {
    return std::any_of(sources.begin(), sources.end(), [&](Treatment const& t) { return t.name == treatment; });
}

Treatment const& CampaignPlan::treatment(std::string_view name) const {
    return named(is_source(name) ? sources : targets, name);
}

Treatment const& CampaignPlan::task(std::string_view name) const { return named(tasks, name); }

KnowledgePlan const& CampaignPlan::knowledge_base(std::string_view name) const {
    auto const found =
        std::find_if(knowledge.begin(), knowledge.end(), [&](KnowledgePlan const& k) { return k.name == name; });
    assert(found != knowledge.end());
    return *found;
}

KnowledgePlan const& built_base(CampaignPlan const& plan, KnowledgePlan const& knowledge) {
    return row_of(knowledge.kind).is_built ? knowledge : built_base(plan, plan.knowledge_base(knowledge.base));
}

std::vector<std::string> CampaignPlan::base_names() const {
    std::vector<std::string> names = names_of(knowledge), of_families = names_of(families);
    names.insert(names.end(), of_families.begin(), of_families.end());
    return names;
}

std::vector<std::string> CampaignPlan::members(std::vector<std::string> const& names) const {
    std::vector<std::string> all;
    for (std::string const& name : names) {
        auto const family =
            std::find_if(families.begin(), families.end(), [&](KnowledgeFamily const& f) { return f.name == name; });
        if (family == families.end()) all.push_back(name);
        else all.insert(all.end(), family->members.begin(), family->members.end());
    }
    return all;
}

PoolPlan const* CampaignPlan::pool(std::string_view name) const {
    auto const found = std::find_if(pools.begin(), pools.end(), [&](PoolPlan const& p) { return p.name == name; });
    return found == pools.end() ? nullptr : &*found;
}

std::string const& CampaignPlan::label(std::string_view name) const {
    PoolPlan const* const found = pool(name);
    return found == nullptr ? treatment(name).label : found->label;
}

std::string CampaignPlan::config_path(Treatment const& treatment) const {
    return (std::filesystem::path{directory} / treatment.config).lexically_normal().string();
}

std::vector<std::string> all_treatments(CampaignPlan const& plan) {
    std::vector<std::string> names = names_of(plan.sources);
    names.insert(names.end(), plan.report_order.begin(), plan.report_order.end());
    return names;
}

int planned_runs(CampaignPlan const& plan) {
    int planned = 0;
    for (std::string const& name : all_treatments(plan)) planned += plan.treatment(name).runs;
    return planned;
}

std::vector<TaskGroup> task_groups(CampaignPlan const& plan) {
    std::vector<TaskGroup> groups{{"", {}}};
    for (Treatment const& task : plan.tasks) groups.push_back({task.name, {}});
    for (TaskGroup& group : groups)
        for (std::string const& name : plan.report_order)
            if (plan.treatment(name).target == group.task) group.treatments.push_back(name);
    if (!plan.tasks.empty()) std::erase_if(groups, [](TaskGroup const& group) { return group.treatments.empty(); });
    return groups;
}

CampaignPlan read_campaign(std::string const& named) {
    std::string const path = current_path(named);
    TomlTable const document = TomlTable::read_file(path);
    if (!document.has("title") && (document.has("arena") || document.has("world") || document.has("evolution")))
        throw UsageError(path, "it is the configuration of one run, not a campaign",
                         "Run it with 'lore-evolve', or name a campaign, such as jobs/campaigns/small.toml.");
    CampaignPlan plan;
    plan.path = path;
    plan.directory = std::filesystem::path{path}.parent_path().string();
    plan.title = document.required_string("title");
    Defaults const defaults = read_defaults(document);
    read_sources(document, defaults, plan);
    read_tasks(document, defaults, plan);
    auto const transfer = read_transfer(document, plan);
    if (transfer) add_transfer_bases(*transfer, plan);
    read_knowledge_bases(document, plan);
    read_treatments(document, defaults, plan);
    if (transfer) add_transfer_treatments(*transfer, plan);
    else refuse_idle_tasks(document, plan);
    read_pools(document, plan);
    read_report(document, plan);
    read_cluster(document, plan);
    document.reject_unknown();
    return plan;
}

}   // namespace lore
