#include "command.h"

#include <lore/core/whole_number.h>
#include <lore/archive/knowledge_export.h>
#include <lore/archive/knowledge_file.h>
#include <lore/knowledge/summary.h>
#include <lore/world/reward_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lore::kb {

namespace {

struct InfoOptions {
    std::string base;
    bool json = false;
};

std::string const& unit_of(KnowledgeBase const& base) { return base.provenance().reward_unit; }
std::string word_of(KnowledgeBase const& base) { return std::string{reward_word(unit_of(base))}; }

nlohmann::ordered_json evidence_json(KnowledgeBase const& base) {
    Evidence const& evidence = base.evidence();
    auto json = nlohmann::ordered_json::object();
    if (evidence.has_returns())
        json["returns"] = {
            {"gammas", evidence.gammas},
            {"showings", std::accumulate(evidence.showings.begin(), evidence.showings.end(), std::uint64_t{0})}};
    if (evidence.has_credit)
        json["credit"] = {{"news", std::accumulate(evidence.news.begin(), evidence.news.end(), std::uint64_t{0})}};
    if (evidence.has_contrast())
        json["contrast"] = {{"success_" + word_of(base), json_number<nlohmann::ordered_json>(*evidence.success_reward)},
                            {"successes", evidence.successes},
                            {"failures", evidence.failures}};
    return json;
}

/// One line a part.
void print_evidence(KnowledgeBase const& base) {
    Evidence const& evidence = base.evidence();
    if (evidence.has_returns()) fmt::print("evidence     returns for gamma {}\n", fmt::join(evidence.gammas, ", "));
    if (evidence.has_credit)
        fmt::print("evidence     credit: {} times a feature was new to a child\n",
                   std::accumulate(evidence.news.begin(), evidence.news.end(), std::uint64_t{0}));
    if (evidence.has_contrast())
        fmt::print("evidence     contrast: {} individuals with at least {} {}, {} contemporaries with {}\n",
                   evidence.successes, reward_text(*evidence.success_reward), unit_of(base), evidence.failures,
                   unit_of(base) == first_reward_unit ? "fewer" : "less");
}

void print_json(KnowledgeBase const& base, ValueSummary const& summary) {
    nlohmann::ordered_json json{{"features", base.size()},
                                {"threshold", base.config().match_threshold},
                                {"window_length", base.config().window_length},
                                {"channels", base.config().channels.count()}};
    if (base.size() > 0) {
        json["values"] = {{"min", summary.lowest}, {"max", summary.highest}, {"mean", summary.mean}};
        json["histogram"] = {{"edges", summary.edges}, {"counts", summary.counts}};
    }
    json["evidence"] = evidence_json(base);
    json["provenance"] = nlohmann::ordered_json::parse(provenance_json(base));
    fmt::print("{}\n", json.dump(2));
}

void print_histogram(KnowledgeBase const& base, ValueSummary const& summary) {
    bool const counts = unit_of(base) == first_reward_unit;   // others may be small or large
    auto const edge = [&](double value) {
        return counts ? fmt::format("{:7.3f}", value) : fmt::format("{:>10.4g}", value);
    };
    constexpr double widest = 40;   // characters
    auto const most = static_cast<double>(*std::max_element(summary.counts.begin(), summary.counts.end()));
    for (std::size_t bin = 0; bin < summary.counts.size(); ++bin) {
        auto const width = std::llround(widest * static_cast<double>(summary.counts[bin]) / most);
        fmt::print("  {} ..{} {:8} {}\n", edge(summary.edges[bin]), edge(summary.edges[bin + 1]), summary.counts[bin],
                   std::string(static_cast<std::size_t>(width), '#'));
    }
}

void print_text(KnowledgeBase const& base, ValueSummary const& summary) {
    fmt::print("features     {}\nwindow       {} steps x {} channels\nthreshold    {} (Euclidean distance)\n",
               base.size(), base.config().window_length, base.config().channels.count(), base.config().match_threshold);
    if (base.size() > 0) {
        fmt::print("values       {:.4g} to {:.4g}, mean {:.4g}\n", summary.lowest, summary.highest, summary.mean);
        print_histogram(base, summary);
    }
    Provenance const& origin = base.provenance();
    fmt::print("kind         {}\nindex        {}\ntask         {}\nindividuals  {}\nwindows      {}\n{:<12} {}\n"
               "sources      {}\n",
               origin.kind, origin.index, origin.task, origin.individuals, origin.windows, "best " + unit_of(base),
               reward_text(origin.best_reward), fmt::join(origin.sources, ", "));
    fmt::print("value rule   {}\n", origin.value.empty() ? text(ValueConfig{}) : origin.value);
    print_evidence(base);
    for (std::string const& step : origin.derivation) fmt::print("then         {}\n", step);
    fmt::print("made by      {}\n", origin.made_by);
}

void info(Program const&, InfoOptions const& options) {
    KnowledgeBase const base = read_knowledge_base(options.base);
    ValueSummary const summary = summarize(base.values(), 10);
    if (options.json) print_json(base, summary);
    else print_text(base, summary);
}

}   // namespace

void add_info(CLI::App& app, Program& program) {
    auto const options = std::make_shared<InfoOptions>();
    CLI::App* const command =
        add_command(app, program, "info", "Show what is in a knowledge base and where it came from", options, info);
    add_base(command, options->base);
    command->add_flag("--json", options->json, "as JSON");
}

}   // namespace lore::kb
