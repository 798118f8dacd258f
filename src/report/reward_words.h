#pragma once

#include <string>
#include <string_view>

namespace lore {

/// How the report speaks of the reward of a campaign's target task.
struct RewardWords {
    std::string unit;        ///< "balls"; "cos"
    std::string noun;        ///< "balls"; "reward"
    std::string collected;   ///< "collected balls"; "reward [cos]"
    std::string number_of;   ///< "number of collected balls"; "reward [cos]"
    std::string so_much;     ///< "so many balls"; "so much reward"
    std::string gets_more;   ///< "collects more balls"; "gets more reward"
    std::string source;      ///< of the source task: "where other balls count"; "whose reward may be another"
};
RewardWords reward_words(std::string_view unit);
/// Of several target tasks, whose rewards have different units.
RewardWords words_of_any_reward();

/// With a capital letter.
std::string capital(std::string text);

}   // namespace lore
