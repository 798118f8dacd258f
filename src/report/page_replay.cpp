#include "html.h"
#include "page_parts.h"
#include "panels.h"
#include "replay_data.h"
#include "report_assets.h"

#include <fmt/format.h>

namespace lore {

namespace {

/// JSON that cannot end the script that holds it: a scene may have any text.
std::string for_script(std::string json) {
    for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
        json.replace(at, 1, "\\u003c");
    return json;
}

}   // namespace

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
        data.push_back(replay_data(replay, data.empty() ? panel : nullptr, all_in_arenas(results.replays)));
    }
    std::string const coloring =
        panel == nullptr
            ? ""
            : fmt::format("The source run's path is colored by {}'s values: blue high, pale low, gray not found.",
                          escaped(knowledge_label(plan, panel->knowledge)));
    bool const arenas = all_in_arenas(results.replays);
    return filled("replay",
                  {{"what", arenas ? "The arena with the robot" : "The world with the path"},
                   {"signs", arenas ? std::string{arena_signs} : "Green: the start. Red: where it is."},
                   {"choices", choices},
                   {"coloring", coloring},
                   {"data", for_script(data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace))}});
}

}   // namespace lore
