#include "command.h"

#include <lore/archive/knowledge_export.h>
#include <lore/archive/knowledge_file.h>
#include <lore/knowledge/summary.h>

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

nlohmann::ordered_json evidence_json(Evidence const& evidence) {
    auto json = nlohmann::ordered_json::object();
    if (evidence.has_returns())
        json["returns"] = {
            {"gammas", evidence.gammas},
            {"showings", std::accumulate(evidence.showings.begin(), evidence.showings.end(), std::uint64_t{0})}};
    if (evidence.has_credit)
        json["credit"] = {{"news", std::accumulate(evidence.news.begin(), evidence.news.end(), std::uint64_t{0})}};
    if (evidence.has_contrast())
        json["contrast"] = {{"success_balls", evidence.success_balls},
                            {"successes", evidence.successes},
                            {"failures", evidence.failures}};
    return json;
}

/// One line a part.
void print_evidence(Evidence const& evidence) {
    if (evidence.has_returns()) fmt::print("evidence     returns for gamma {}\n", fmt::join(evidence.gammas, ", "));
    if (evidence.has_credit)
        fmt::print("evidence     credit: {} times a feature was new to a child\n",
                   std::accumulate(evidence.news.begin(), evidence.news.end(), std::uint64_t{0}));
    if (evidence.has_contrast())
        fmt::print("evidence     contrast: {} individuals with at least {} balls, {} contemporaries with fewer\n",
                   evidence.successes, evidence.success_balls, evidence.failures);
}

void print_json(KnowledgeBase const& base, ValueSummary const& summary) {
    nlohmann::ordered_json json{{"features", base.size()},
                                {"threshold", base.config().match_threshold},
                                {"window_length", base.config().window_length},
                                {"channels", channel_count}};
    if (base.size() > 0) {
        json["values"] = {{"min", summary.lowest}, {"max", summary.highest}, {"mean", summary.mean}};
        json["histogram"] = {{"edges", summary.edges}, {"counts", summary.counts}};
    }
    json["evidence"] = evidence_json(base.evidence());
    json["provenance"] = nlohmann::ordered_json::parse(provenance_json(base.provenance()));
    fmt::print("{}\n", json.dump(2));
}

void print_histogram(ValueSummary const& summary) {
    constexpr double widest = 40;   // characters
    auto const most = static_cast<double>(*std::max_element(summary.counts.begin(), summary.counts.end()));
    for (std::size_t bin = 0; bin < summary.counts.size(); ++bin) {
        auto const width = std::llround(widest * static_cast<double>(summary.counts[bin]) / most);
        fmt::print("  {:7.3f} ..{:7.3f} {:8} {}\n", summary.edges[bin], summary.edges[bin + 1], summary.counts[bin],
                   std::string(static_cast<std::size_t>(width), '#'));
    }
}

void print_text(KnowledgeBase const& base, ValueSummary const& summary) {
    fmt::print("features     {}\nwindow       {} steps x {} channels\nthreshold    {} (Euclidean distance)\n",
               base.size(), base.config().window_length, channel_count, base.config().match_threshold);
    if (base.size() > 0) {
        fmt::print("values       {:.4g} to {:.4g}, mean {:.4g}\n", summary.lowest, summary.highest, summary.mean);
        print_histogram(summary);
    }
    Provenance const& origin = base.provenance();
    fmt::print("kind         {}\nindex        {}\ntask         {}\nindividuals  {}\nwindows      {}\nbest balls   "
               "{}\nsources      {}\n",
               origin.kind, origin.index, origin.task, origin.individuals, origin.windows, origin.best_balls,
               fmt::join(origin.sources, ", "));
    fmt::print("value rule   {}\n", origin.value.empty() ? text(ValueConfig{}) : origin.value);
    print_evidence(base.evidence());
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
