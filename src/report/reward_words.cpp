#include "reward_words.h"

#include <lore/world/reward_text.h>

#include <fmt/format.h>

namespace lore {

RewardWords reward_words(std::string_view unit) {
    std::string const noun{reward_word(unit)};
    if (unit == first_reward_unit)
        return {noun,
                noun,
                "collected " + noun,
                "number of collected " + noun,
                "so many " + noun,
                "collects more " + noun,
                fmt::format("where other {} count", noun)};
    RewardWords words = words_of_any_reward();
    words.unit = unit;
    words.collected = words.number_of = fmt::format("reward [{}]", unit);
    return words;
}

RewardWords words_of_any_reward() {
    return {"unit of reward",
            "reward",
            "reward",
            "reward",
            "so much reward",
            "gets more reward",
            "whose reward may be another"};
}

std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

}   // namespace lore
