#pragma once

#include <string>
#include <string_view>

namespace lore::test {

/// How often `part` stands in `text`.
inline int count(std::string const& text, std::string_view part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}   // namespace lore::test
