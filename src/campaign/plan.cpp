#include <lore/campaign/plan.h>

#include "knowledge_kinds.h"
#include "plan_reading.h"
#include "treatment_inputs.h"

#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/toml.h>
#include <lore/experiment/config.h>
#include <lore/experiment/knowledge_building.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <set>

#include <fmt/format.h>

namespace lore {

namespace {

using Names = std::vector<std::string>;

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

/// All keys but `name`. Nothing that it names is looked at.
Treatment read_treatment(TomlTable const& table, Defaults const& defaults, std::string name) {
    Treatment treatment;
    treatment.name = std::move(name);
    treatment.label = table.string("label").value_or(treatment.name);
    treatment.config = table.required_string("config");
    for (TreatmentInput const& input : treatment_inputs()) treatment.*input.name = table.string(input.key).value_or("");
    treatment.runs = static_cast<int>(table.integer("runs", 0, most_runs).value_or(defaults.runs));
    treatment.first_seed =
        static_cast<std::uint64_t>(table.integer("first_seed", 0, most_seed).value_or(defaults.first_seed));
    std::int64_t const generations = table.integer("generations", 1, most_generations).value_or(defaults.generations);
    if (generations != 0) treatment.overrides.push_back(fmt::format("evolution.generations={}", generations));
    for (std::string& setting : table.strings("set").value_or(Names{}))
        treatment.overrides.push_back(std::move(setting));
    table.reject_unknown();
    return treatment;
}

// ---- the tables of the file: one function each ----

void read_source(TomlTable const& document, Defaults const& defaults, CampaignPlan& plan) {
    TomlTable const table = document.required_table("source");
    plan.source = read_treatment(table, defaults, "source");
    for (TreatmentInput const& input : treatment_inputs())
        if (!(plan.source.*input.name).empty())
            table.fail(input.key, "the source treatment takes nothing from other steps", "Remove it.");
    read_windows(table, plan.config_path(plan.source), plan.source.overrides);
}

void check_knowledge(TomlTable const& table, KnowledgePlan const& knowledge, CampaignPlan const& plan) {
    Names bases;
    for (KnowledgePlan const& former : plan.knowledge) bases.push_back(former.name);
    require_new(table, knowledge.name, bases);
    KnowledgeKindRow const& kind = row_of(knowledge.kind);
    if (!knowledge.base.empty()) require_known(table, kind.key, knowledge.base, bases);
    for (std::string const& other : knowledge.consensus) require_known(table, "consensus", other, bases);
    if (knowledge.run > plan.source.runs)
        table.fail("run", fmt::format("there are only {} source runs", plan.source.runs),
                   "Name one of them, or raise their number.");
    if (kind.base_has_lineage && plan.knowledge_base(knowledge.base).kind != KnowledgeKind::lineage)
        table.fail(kind.key, "it must name a knowledge base with 'balls', 'reward' or 'run'");
}

bool has_option(KnowledgePlan const& knowledge, std::string_view option) {
    return std::any_of(knowledge.options.begin(), knowledge.options.end(),
                       [&](std::string const& word) { return word.starts_with(option); });
}

/// Discounts of which a base gathers returns so that those of `gamma` are among them. Those that its options name come
/// on top.
std::vector<double> gammas_with(double gamma, KnowledgePlan const& built) {
    bool const has_own = has_option(built, "--gammas");
    std::vector<double> gammas = built.gammas;
    if (gammas.empty() && !has_own) gammas = default_gammas();
    if (std::find(gammas.begin(), gammas.end(), gamma) != gammas.end()) return built.gammas;
    gammas.insert(std::upper_bound(gammas.begin(), gammas.end(), gamma), gamma);
    return gammas;
}

/// Has the base that the evidence comes from gather what the rule needs.
void ask_for_evidence(TomlTable const& table, KnowledgePlan const& revalued, CampaignPlan& plan) {
    std::string const from = built_base(plan, revalued).name;
    KnowledgePlan& built = *std::find_if(plan.knowledge.begin(), plan.knowledge.end(),
                                         [&](KnowledgePlan const& k) { return k.name == from; });
    ValueConfig const& value = revalued.value;
    try {
        check_evidence_of(built.kind == KnowledgeKind::all ? BuiltFrom::everybody : BuiltFrom::lineage, value.rule);
    } catch (UsageError const& error) { table.fail("value", error.what()); }
    if (value.rule == ValueRule::discounted_return) {
        built.gammas = gammas_with(value.gamma, built);
        if (built.gammas.size() > most_gammas)
            table.fail("gamma", fmt::format("'{}' would need returns for more than {} gammas", from, most_gammas),
                       "Revalue by fewer.");
    }
    if (!value.success_reward) return;
    if (has_option(built, "--success"))
        table.fail("success", fmt::format("the options of '{}' have --success", from), "Leave one of the two out.");
    if (built.success_reward && built.success_reward != value.success_reward)
        table.fail("success", fmt::format("'{}' counts successes of {} already", from, *built.success_reward),
                   "Build another base for it.");
    built.success_reward = value.success_reward;
}

void read_knowledge_bases(TomlTable const& document, CampaignPlan& plan) {
    for (TomlTable const& table : document.tables("knowledge")) {
        KnowledgePlan knowledge = read_knowledge(table);
        check_knowledge(table, knowledge, plan);
        if (knowledge.kind == KnowledgeKind::revalued) ask_for_evidence(table, knowledge, plan);
        plan.knowledge.push_back(std::move(knowledge));
    }
    auto const from_lineages = std::count_if(plan.knowledge.begin(), plan.knowledge.end(),
                                             [](KnowledgePlan const& k) { return k.kind == KnowledgeKind::lineage; });
    if (from_lineages > plan.source.runs)
        document.fail("knowledge", fmt::format("{} knowledge bases need as many source runs, and there are {}",
                                               from_lineages, plan.source.runs));
}

void read_treatments(TomlTable const& document, Defaults const& defaults, CampaignPlan& plan) {
    Names names{plan.source.name};
    for (TomlTable const& table : document.tables("treatment")) {
        std::string name = read_name(table);
        if (reserved_names.contains(name)) table.fail("name", fmt::format("'{}' is reserved", name), "Choose another.");
        Treatment treatment = read_treatment(table, defaults, std::move(name));
        require_new(table, treatment.name, names);
        read_windows(table, plan.config_path(treatment), treatment.overrides);
        for (TreatmentInput const& input : treatment_inputs())
            if (!(treatment.*input.name).empty()) input.fit(table, plan, treatment);
        names.push_back(treatment.name);
        plan.targets.push_back(std::move(treatment));
    }
}

void check_against(TomlTable const& table, PoolPlan const& pool, CampaignPlan const& plan) {
    for (std::string const& other : pool.against) {
        PoolPlan const* const of_others = plan.pool(other);
        Names const others = of_others == nullptr ? Names{other} : of_others->treatments;
        for (std::string const& name : others)
            if (std::find(pool.treatments.begin(), pool.treatments.end(), name) != pool.treatments.end())
                table.fail("against", fmt::format("'{}' would be compared with itself", name),
                           "Name other treatments.");
    }
}

void read_pools(TomlTable const& document, CampaignPlan& plan) {
    Names treatments;
    for (Treatment const& treatment : plan.targets) treatments.push_back(treatment.name);
    Names comparable = treatments, names = treatments;
    names.push_back(plan.source.name);
    for (TomlTable const& table : document.tables("pool")) {
        PoolPlan pool;
        pool.name = read_name(table);
        require_new(table, pool.name, names);
        pool.label = table.string("label").value_or(pool.name);
        pool.treatments = table.strings("treatments").value_or(Names{});
        for (std::string const& name : pool.treatments) require_known(table, "treatments", name, treatments);
        std::set<std::string> const different(pool.treatments.begin(), pool.treatments.end());
        if (different.empty() || different.size() != pool.treatments.size())
            table.fail("treatments", "it must name one treatment or more, each once");
        pool.against = table.strings("against").value_or(Names{});
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

Names read_order(TomlTable const& table, Names const& treatments) {
    auto order = table.strings("order");
    if (!order) return treatments;
    for (std::string const& name : *order) require_known(table, "order", name, treatments);
    if (std::set<std::string>(order->begin(), order->end()).size() != treatments.size() ||
        order->size() != treatments.size())
        table.fail("order", "it must name every treatment once");
    return *std::move(order);
}

FigurePlan read_figures(TomlTable const& table, CampaignPlan const& plan) {
    Names bases;
    for (KnowledgePlan const& knowledge : plan.knowledge) bases.push_back(knowledge.name);
    FigurePlan figures;
    figures.trajectory = table.string("trajectory").value_or("");
    figures.figure5 = table.strings("figure5").value_or(Names{});
    figures.figure6 = table.strings("figure6").value_or(Names{});
    if (!figures.trajectory.empty()) {
        require_known(table, "trajectory", figures.trajectory, bases);
        if (plan.knowledge_base(figures.trajectory).kind != KnowledgeKind::lineage)
            table.fail("trajectory", "it must name a knowledge base made from a lineage");
    }
    for (std::string const& name : figures.figure5) require_known(table, "figure5", name, bases);
    for (std::string const& name : figures.figure6) require_known(table, "figure6", name, bases);
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
    for (Treatment const& treatment : plan.targets) plan.report_order.push_back(treatment.name);
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
    cluster.options = table->strings("options").value_or(Names{});
    table->reject_unknown();
}

}   // namespace

Treatment const& CampaignPlan::treatment(std::string_view name) const {
    if (source.name == name) return source;
    auto const found = std::find_if(targets.begin(), targets.end(), [&](Treatment const& t) { return t.name == name; });
    assert(found != targets.end());
    return *found;
}

KnowledgePlan const& CampaignPlan::knowledge_base(std::string_view name) const {
    auto const found =
        std::find_if(knowledge.begin(), knowledge.end(), [&](KnowledgePlan const& k) { return k.name == name; });
    assert(found != knowledge.end());
    return *found;
}

KnowledgePlan const& built_base(CampaignPlan const& plan, KnowledgePlan const& knowledge) {
    return row_of(knowledge.kind).is_built ? knowledge : built_base(plan, plan.knowledge_base(knowledge.base));
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
    read_source(document, defaults, plan);
    read_knowledge_bases(document, plan);
    read_treatments(document, defaults, plan);
    read_pools(document, plan);
    read_report(document, plan);
    read_cluster(document, plan);
    document.reject_unknown();
    return plan;
}

}   // namespace lore
