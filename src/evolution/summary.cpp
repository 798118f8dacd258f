#include <lore/evolution/summary.h>

#include <algorithm>
#include <limits>
#include <map>

namespace lore {

GenerationSummary summarize(GenerationReport const& report, double nothing_shown) {
    std::vector<Individual> const& members = report.state->population.members;
    GenerationSummary summary;
    summary.generation = report.generation;
    summary.distance = report.distance;
    summary.shaping_serves = report.shaping_serves;
    summary.fronts = report.fronts;

    std::map<std::array<double, 3>, int> sharing;
    int at_max = 0;
    summary.best_reward = summary.best_shaping = -std::numeric_limits<double>::infinity();
    for (Individual const& member : members) {
        Birth const& birth = *member.birth;
        summary.best_reward = std::max(summary.best_reward, birth.reward);
        summary.mean_reward += birth.reward;
        summary.mean_diversity += member.diversity;
        summary.mean_connections += static_cast<double>(birth.genome.edges.size());
        summary.mean_hidden += birth.genome.hidden_count();
        if (member.shaping > summary.best_shaping) {
            summary.best_shaping = member.shaping;
            at_max = 0;
        }
        if (member.shaping == summary.best_shaping && member.shaping != nothing_shown) ++at_max;
        ++sharing[member.objectives.value];
    }
    double const count = static_cast<double>(members.size());
    for (double* mean :
         {&summary.mean_reward, &summary.mean_diversity, &summary.mean_connections, &summary.mean_hidden})
        *mean /= count;
    summary.shaping_at_max = at_max / count;
    for (auto const& [objectives, sharers] : sharing)
        if (sharers > 1) summary.tied += sharers;

    summary.evaluations = report.born.size();
    for (Individual const& child : report.born) summary.steps += static_cast<std::uint64_t>(child.descriptors->steps());
    return summary;
}

}   // namespace lore
