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
    std::string const with_unit = fmt::format("reward [{}]", unit);
    return {std::string{unit},
            noun,
            with_unit,
            with_unit,
            "so much reward",
            "gets more reward",
            "whose reward may be another"};
}

std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

}   // namespace lore
