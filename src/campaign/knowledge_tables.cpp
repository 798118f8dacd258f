#include "knowledge_tables.h"

#include "knowledge_kinds.h"
#include "plan_reading.h"

#include <lore/core/error.h>
#include <lore/experiment/knowledge_building.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace lore {

namespace {

/// The source whose runs it comes from: of its base, the one that it names, or the only one.
std::string source_of(TomlTable const& table, KnowledgePlan const& knowledge, CampaignPlan const& plan) {
    if (!knowledge.base.empty()) return plan.knowledge_base(knowledge.base).source;
    if (!knowledge.source.empty()) {
        require_known(table, knowledge.best_run ? "best_of" : "source", knowledge.source, names_of(plan.sources));
        return knowledge.source;
    }
    if (plan.sources.size() > 1)
        table.fail("name", fmt::format("it does not say of which of the {} source tasks", plan.sources.size()),
                   fmt::format("Add source = \"{}\", or another.", plan.sources.front().name));
    return plan.sources.front().name;
}

void check_knowledge(TomlTable const& table, KnowledgePlan const& knowledge, CampaignPlan const& plan) {
    NameList const bases = names_of(plan.knowledge);
    require_new(table, knowledge.name, plan.base_names());
    KnowledgeKindRow const& kind = row_of(knowledge.kind);
    if (!knowledge.base.empty()) require_known(table, kind.key, knowledge.base, bases);
    for (std::string const& other : knowledge.consensus) require_known(table, "consensus", other, bases);
    if (kind.base_has_lineage && plan.knowledge_base(knowledge.base).kind != KnowledgeKind::lineage)
        table.fail(kind.key, "it must name a knowledge base with 'balls', 'reward', 'run' or 'best_of'");
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
    } catch (UsageError const& error) { table.fail("value", error); }
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

bool is_family(KnowledgePlan const& knowledge, CampaignPlan const& plan) {
    return knowledge.run == each_run ||
           std::any_of(plan.families.begin(), plan.families.end(),
                       [&](KnowledgeFamily const& family) { return family.name == knowledge.base; });
}

/// One base of each source run, or from each base of a family; each draws by a seed of its own.
void add_family(TomlTable const& table, KnowledgePlan const& knowledge, CampaignPlan& plan) {
    require_new(table, knowledge.name, plan.base_names());
    bool const is_first = knowledge.run == each_run;
    NameList const bases = is_first ? NameList{} : plan.members(NameList{knowledge.base});
    int const count =
        is_first ? plan.treatment(source_of(table, knowledge, plan)).runs : static_cast<int>(bases.size());
    if (count == 0) table.fail("run", "its source has no runs", "Raise their number.");
    KnowledgeFamily family{knowledge.name, {}};
    for (int k = 1; k <= count; ++k) {
        KnowledgePlan member = knowledge;
        member.name = fmt::format("{}{}", knowledge.name, k);
        member.label = fmt::format("{} {}", knowledge.label, k);
        if (is_first) member.run = k;
        else member.base = bases[static_cast<std::size_t>(k - 1)];
        member.seed = knowledge.seed + static_cast<std::uint64_t>(k) - 1;
        family.members.push_back(member.name);
        add_knowledge(table, std::move(member), plan);
    }
    plan.families.push_back(std::move(family));
}

}   // namespace

void add_knowledge(TomlTable const& table, KnowledgePlan knowledge, CampaignPlan& plan) {
    check_knowledge(table, knowledge, plan);
    knowledge.source = source_of(table, knowledge, plan);
    Treatment const& source = plan.treatment(knowledge.source);
    if (knowledge.run > source.runs)
        table.fail("run", fmt::format("the last {} run is {}", source.name, source.runs),
                   "Name that or an earlier one, or raise the number of runs.");
    if (knowledge.kind == KnowledgeKind::revalued) ask_for_evidence(table, knowledge, plan);
    plan.knowledge.push_back(std::move(knowledge));
}

void read_knowledge_bases(TomlTable const& document, CampaignPlan& plan) {
    for (TomlTable const& table : document.tables("knowledge")) {
        KnowledgePlan knowledge = read_knowledge(table);
        knowledge.consensus = plan.members(knowledge.consensus);
        if (is_family(knowledge, plan)) add_family(table, knowledge, plan);
        else add_knowledge(table, knowledge, plan);
    }
    for (Treatment const& source : plan.sources) {
        auto const from_lineages =
            std::count_if(plan.knowledge.begin(), plan.knowledge.end(), [&](KnowledgePlan const& k) {
                return k.kind == KnowledgeKind::lineage && k.source == source.name;
            });
        if (from_lineages > source.runs)
            document.fail("knowledge",
                          fmt::format("{} knowledge bases need as many {} runs, and there are {}", from_lineages,
                                      source.name, source.runs),
                          "Raise the number of runs; where run = \"each\" takes them all, make other bases from its "
                          "members with lineage_of.");
    }
}

}   // namespace lore
