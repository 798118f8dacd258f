#pragma once

#include <string>
#include <string_view>

namespace lore {

/// The unit of stored results that state none: they are older than other worlds.
inline constexpr std::string_view first_reward_unit = "balls";

/// A reward for people: whole ones without decimals, others with 4 significant digits: "5", "-123.4".
std::string reward_text(double reward);

/// The same with its unit, in the singular for 1 of what is counted: "5 balls", "1 ball", "-123.4 cos"; of an empty
/// unit the number alone.
std::string reward_text(double reward, std::string_view unit);

/// How the columns of tables and the fields of JSON documents call a reward: "balls" for that unit, as they always
/// have, else "reward".
std::string_view reward_word(std::string_view unit);

}   // namespace lore
