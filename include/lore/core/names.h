#pragma once

#include <lore/core/error.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lore {

/// The names of an enumeration's values, in their order: what configurations, command lines and files call them.
template <class Choice, std::size_t count>
struct Names {
    std::array<std::string_view, count> words;

    constexpr std::string_view operator[](Choice choice) const { return words[static_cast<std::size_t>(choice)]; }

    constexpr std::optional<Choice> find(std::string_view wanted) const {
        for (std::size_t at = 0; at < count; ++at)
            if (words[at] == wanted) return static_cast<Choice>(at);
        return std::nullopt;
    }

    /// All of them, with commas between them.
    std::string list() const {
        std::string all;
        for (std::string_view const word : words) all.append(all.empty() ? "" : ", ").append(word);
        return all;
    }

    /// Throws UsageError for an unknown one; `kind` is what all of them are: "a shaping rule".
    Choice choice(std::string_view wanted, std::string_view kind) const {
        if (auto const found = find(wanted)) return *found;
        throw UsageError(std::string{"'"}.append(wanted).append("' is not ").append(kind), "known are " + list(),
                         "Correct the name.");
    }
};

/// names_for<TieRule>("random", "older", "younger")
template <class Choice, class... Words>
constexpr Names<Choice, sizeof...(Words)> names_for(Words... words) {
    return {{words...}};
}

}   // namespace lore
