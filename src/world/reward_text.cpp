#include <lore/world/reward_text.h>

#include <lore/core/whole_number.h>

#include <fmt/format.h>

namespace lore {

namespace {

/// Without the last s of a plural, as far as that can be told: "balls" is one, "cos" and "loss" are none.
std::string_view singular(std::string_view unit) {
    bool const plural = unit.size() > 3 && unit.ends_with('s') && !unit.ends_with("ss") && !unit.ends_with("us") &&
                        !unit.ends_with("is");
    return plural ? unit.substr(0, unit.size() - 1) : unit;
}

}   // namespace

std::string reward_text(double reward) {
    if (reward == 0) return "0";   // not "-0"
    return is_whole(reward) ? fmt::format("{:.0f}", reward) : fmt::format("{:.4g}", reward);
}

std::string reward_text(double reward, std::string_view unit) {
    if (unit.empty()) return reward_text(reward);
    return fmt::format("{} {}", reward_text(reward), reward == 1 ? singular(unit) : unit);
}

std::string_view reward_word(std::string_view unit) { return unit == first_reward_unit ? unit : "reward"; }

}   // namespace lore
