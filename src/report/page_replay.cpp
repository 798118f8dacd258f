#include "html.h"
#include "page_parts.h"
#include "panels.h"
#include "replay_data.h"

#include <fmt/format.h>

namespace lore {

std::string replay_section(CampaignPlan const& plan, Results const& results) {
    if (results.replays.empty()) return "";
    PanelValues const* const panel = results.panels.empty() ? nullptr : &results.panels.front();
    std::string choices;
    auto data = nlohmann::ordered_json::array();
    for (Replay const& replay : results.replays) {
        std::size_t const slash = replay.run.find('/');
        choices += fmt::format("<option value=\"{}\">{}: best of run {}</option>", data.size(),
                               escaped(plan.treatment(replay.run.substr(0, slash)).label),
                               escaped(replay.run.substr(slash + 1)));
        data.push_back(replay_data(replay, data.empty() ? panel : nullptr));
    }
    std::string const coloring =
        panel == nullptr
            ? ""
            : fmt::format("The source run's path is colored by {}'s values: blue high, pale low, gray not found.",
                          escaped(knowledge_label(plan, panel->knowledge)));
    return filled("replay", {{"choices", choices}, {"coloring", coloring}, {"data", data.dump()}});
}

}   // namespace lore
