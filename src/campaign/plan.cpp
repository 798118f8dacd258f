#include <lore/campaign/plan.h>

#include <lore/core/error.h>
#include <lore/core/toml.h>
#include <lore/experiment/config.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <limits>
#include <set>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr std::int64_t most_runs = 9999;
constexpr std::int64_t most_seed = std::numeric_limits<std::int64_t>::max() / 2;
// Steps of other kinds than runs have names that start with these words.
std::set<std::string, std::less<>> const reserved_names{"choose", "knowledge", "archive", "report"};

bool is_name(std::string_view text) {
    return !text.empty() && text.size() <= 40 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-';
    });
}

/// Values that treatments share unless they have their own.
struct Defaults {
    std::int64_t runs = 30;
    std::int64_t first_seed = 1;
    std::int64_t generations = 0;   ///< 0: as the configuration says
};

Treatment read_treatment(TomlTable const& table, Defaults const& defaults, std::string name) {
    Treatment treatment;
    treatment.name = name.empty() ? table.required_string("name") : std::move(name);
    if (!is_name(treatment.name)) table.fail("name", "a name is 1 to 40 letters, digits, '_' or '-'");
    if (reserved_names.contains(treatment.name))
        table.fail("name", fmt::format("'{}' is reserved", treatment.name), "Choose another.");
    treatment.label = table.string("label").value_or(treatment.name);
    treatment.config = table.required_string("config");
    treatment.knowledge = table.string("knowledge").value_or("");
    treatment.runs = static_cast<int>(table.integer("runs", 0, most_runs).value_or(defaults.runs));
    treatment.first_seed =
        static_cast<std::uint64_t>(table.integer("first_seed", 0, most_seed).value_or(defaults.first_seed));
    std::int64_t const generations = table.integer("generations", 1, 10'000'000).value_or(defaults.generations);
    if (generations != 0) treatment.overrides.push_back(fmt::format("evolution.generations={}", generations));
    for (std::string& setting : table.strings("set").value_or(std::vector<std::string>{}))
        treatment.overrides.push_back(std::move(setting));
    table.reject_unknown();
    return treatment;
}

/// The one key of `choices` that the table has.
std::string_view only_key(TomlTable const& table, std::vector<std::string_view> const& choices) {
    std::string_view found;
    for (std::string_view key : choices) {
        if (!table.has(key)) continue;
        if (!found.empty()) table.fail(key, fmt::format("it excludes '{}'", found), "Keep one of them.");
        found = key;
    }
    if (found.empty()) {
        table.reject_unknown();   // one of them misspelt, most likely
        table.fail("name", fmt::format("one of {} is missing", fmt::join(choices, ", ")), "Add one.");
    }
    return found;
}

/// Whether Algorithm 1 makes it; the others are made of a base that is there.
bool is_built(KnowledgeKind kind) { return kind != KnowledgeKind::random && kind != KnowledgeKind::reduced; }

KnowledgePlan read_knowledge(TomlTable const& table) {
    KnowledgePlan plan;
    plan.name = table.required_string("name");
    if (!is_name(plan.name)) table.fail("name", "a name is 1 to 40 letters, digits, '_' or '-'");
    plan.label = table.string("label").value_or(plan.name);
    std::string_view const key = only_key(table, {"balls", "run", "lineage_of", "all_of", "random_of", "part_of"});
    if (key == "balls") {
        plan.balls = table.required_number("balls", 0, 1e6);
    } else if (key == "run") {
        plan.run = static_cast<int>(*table.integer("run", 1, most_runs));
    } else {
        plan.kind = key == "lineage_of"  ? KnowledgeKind::same_lineage
                    : key == "all_of"    ? KnowledgeKind::all
                    : key == "random_of" ? KnowledgeKind::random
                                         : KnowledgeKind::reduced;
        plan.base = table.required_string(key);
    }
    if (plan.kind == KnowledgeKind::random)
        plan.seed = static_cast<std::uint64_t>(table.integer("seed", 0, most_seed).value_or(1));
    else plan.options = table.strings("options").value_or(std::vector<std::string>{});
    if (is_built(plan.kind)) {
        for (std::string const& option : plan.options)
            if (option.starts_with("--window-length") || option.starts_with("--threshold"))
                table.fail("options", fmt::format("'{}' is for the runs that use the base too", option),
                           "Write window_length = or match_threshold = instead.");
        plan.match_threshold = table.number("match_threshold", 0, 1000);
        if (auto const steps = table.integer("window_length", 1, longest_window))
            plan.window_length = static_cast<int>(*steps);
    }
    if (plan.kind == KnowledgeKind::reduced) {
        std::string_view const how = only_key(table, {"top", "least_value", "least_count", "consensus"});
        auto const reduce_by = [&](std::string_view option, auto bound) {
            plan.options.insert(plan.options.begin(), {std::string{option}, fmt::format("{}", bound)});
        };
        if (how == "top") reduce_by("--top", *table.integer(how, 1, 100'000'000));
        if (how == "least_value") reduce_by("--min-value", *table.number(how, -1, 1e6));
        if (how == "least_count") reduce_by("--min-count", *table.integer(how, 1, 100'000'000));
        if (how == "consensus") plan.consensus = *table.strings("consensus");
    }
    table.reject_unknown();
    return plan;
}

void check_name(TomlTable const& document, std::string_view key, std::string const& wanted,
                std::vector<std::string> const& known) {
    if (std::find(known.begin(), known.end(), wanted) != known.end()) return;
    std::vector<std::string_view> const words(known.begin(), known.end());
    std::string const meant = nearest_word(wanted, words.data(), words.size());
    document.fail(key, fmt::format("there is no '{}' before it", wanted),
                  meant.empty() ? "Define it first." : fmt::format("Did you mean '{}'?", meant));
}

/// What `lore-kb build` will cut the windows of a base by: its own keys, else what its source run was configured with.
KnowledgeConfig windows_of(CampaignPlan const& plan, KnowledgePlan const& knowledge, KnowledgeConfig config) {
    if (!is_built(knowledge.kind)) return windows_of(plan, plan.knowledge_base(knowledge.base), config);
    config.window_length = knowledge.window_length.value_or(config.window_length);
    if (knowledge.match_threshold) config.match_threshold = static_cast<float>(*knowledge.match_threshold);
    return config;
}

/// Windows that a treatment's runs read. A mistake in its configuration is one of this campaign's file.
KnowledgeConfig windows_read(TomlTable const& table, std::string const& config_path,
                             std::vector<std::string> const& overrides) {
    try {
        return read_config(config_path, overrides).knowledge;
    } catch (Error const& error) { table.fail(table.has("set") ? "set" : "config", error.what()); }
}

/// Has a treatment's runs read the windows of its base, unless its configuration does so already.
void fit_windows(TomlTable const& table, std::string const& config_path, Treatment& treatment,
                 KnowledgeConfig const& base) {
    if (windows_read(table, config_path, {}) != base)
        treatment.overrides.insert(treatment.overrides.begin(),
                                   {fmt::format("knowledge.window_length={}", base.window_length),
                                    fmt::format("knowledge.match_threshold={}", base.match_threshold)});
    KnowledgeConfig const read = windows_read(table, config_path, treatment.overrides);
    if (read != base)
        table.fail("set",
                   fmt::format("it asks for windows of {} steps and threshold {}, and '{}' has {} and {}",
                               read.window_length, read.match_threshold, treatment.knowledge, base.window_length,
                               base.match_threshold),
                   "Leave them out: a treatment takes those of its base.");
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

std::string CampaignPlan::config_path(Treatment const& treatment) const {
    return (std::filesystem::path{directory} / treatment.config).lexically_normal().string();
}

CampaignPlan read_campaign(std::string const& path) {
    TomlTable const document = TomlTable::read_file(path);
    CampaignPlan plan;
    plan.path = path;
    plan.directory = std::filesystem::path{path}.parent_path().string();
    plan.title = document.required_string("title");

    Defaults defaults;
    defaults.runs = document.integer("runs", 1, most_runs).value_or(defaults.runs);
    defaults.first_seed = document.integer("first_seed", 0, most_seed).value_or(defaults.first_seed);
    defaults.generations = document.integer("generations", 1, 10'000'000).value_or(0);

    TomlTable const source = document.required_table("source");
    plan.source = read_treatment(source, defaults, "source");
    if (!plan.source.knowledge.empty()) document.fail("source", "the source treatment cannot use a knowledge base");
    KnowledgeConfig const source_windows = windows_read(source, plan.config_path(plan.source), plan.source.overrides);

    std::vector<std::string> bases;
    for (TomlTable const& table : document.tables("knowledge")) {
        KnowledgePlan knowledge = read_knowledge(table);
        if (std::find(bases.begin(), bases.end(), knowledge.name) != bases.end())
            table.fail("name", fmt::format("'{}' is defined twice", knowledge.name), "Rename one.");
        if (!knowledge.base.empty()) check_name(table, "name", knowledge.base, bases);
        for (std::string const& other : knowledge.consensus) check_name(table, "consensus", other, bases);
        if (knowledge.run > plan.source.runs)
            table.fail("run", fmt::format("there are only {} source runs", plan.source.runs),
                       "Name one of them, or raise their number.");
        bases.push_back(knowledge.name);
        plan.knowledge.push_back(std::move(knowledge));
        KnowledgeKind const kind = plan.knowledge.back().kind;
        if ((kind == KnowledgeKind::all || kind == KnowledgeKind::same_lineage) &&
            plan.knowledge_base(plan.knowledge.back().base).kind != KnowledgeKind::lineage)
            table.fail(kind == KnowledgeKind::all ? "all_of" : "lineage_of",
                       "it must name a knowledge base with 'balls' or 'run'");
    }
    auto const from_lineages = std::count_if(plan.knowledge.begin(), plan.knowledge.end(),
                                             [](KnowledgePlan const& k) { return k.kind == KnowledgeKind::lineage; });
    if (from_lineages > plan.source.runs)
        document.fail("knowledge", fmt::format("{} knowledge bases need as many source runs, and there are {}",
                                               from_lineages, plan.source.runs));

    std::vector<std::string> names;
    for (TomlTable const& table : document.tables("treatment")) {
        Treatment treatment = read_treatment(table, defaults, "");
        if (treatment.name == plan.source.name || std::find(names.begin(), names.end(), treatment.name) != names.end())
            table.fail("name", fmt::format("'{}' is defined twice", treatment.name), "Rename one.");
        std::string const config_path = plan.config_path(treatment);
        if (treatment.knowledge.empty()) {
            windows_read(table, config_path, treatment.overrides);
        } else {
            check_name(table, "knowledge", treatment.knowledge, bases);
            fit_windows(table, config_path, treatment,
                        windows_of(plan, plan.knowledge_base(treatment.knowledge), source_windows));
        }
        names.push_back(treatment.name);
        plan.targets.push_back(std::move(treatment));
    }

    plan.report_order = names;
    if (auto const report = document.table("report")) {
        if (auto order = report->strings("order")) {
            for (std::string const& name : *order) check_name(*report, "order", name, names);
            if (std::set<std::string>(order->begin(), order->end()).size() != names.size() ||
                order->size() != names.size())
                report->fail("order", "it must name every treatment once");
            plan.report_order = *std::move(order);
        }
        plan.figures.trajectory = report->string("trajectory").value_or("");
        plan.figures.figure5 = report->strings("figure5").value_or(std::vector<std::string>{});
        plan.figures.figure6 = report->strings("figure6").value_or(std::vector<std::string>{});
        if (!plan.figures.trajectory.empty()) {
            check_name(*report, "trajectory", plan.figures.trajectory, bases);
            if (plan.knowledge_base(plan.figures.trajectory).kind != KnowledgeKind::lineage)
                report->fail("trajectory", "it must name a knowledge base made from a lineage");
        }
        for (std::string const& name : plan.figures.figure5) check_name(*report, "figure5", name, bases);
        for (std::string const& name : plan.figures.figure6) check_name(*report, "figure6", name, bases);
        report->reject_unknown();
    }
    if (auto const cluster = document.table("cluster")) {
        plan.cluster.time_limit = cluster->string("time_limit").value_or(plan.cluster.time_limit);
        plan.cluster.warning_seconds =
            static_cast<int>(cluster->integer("warning_seconds", 1, 3600).value_or(plan.cluster.warning_seconds));
        plan.cluster.concurrent =
            static_cast<int>(cluster->integer("concurrent", 1, 100'000).value_or(plan.cluster.concurrent));
        plan.cluster.options = cluster->strings("options").value_or(std::vector<std::string>{});
        cluster->reject_unknown();
    }
    document.reject_unknown();
    return plan;
}

}   // namespace lore
