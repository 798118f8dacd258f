#pragma once

#include <algorithm>
#include <cstddef>

namespace lore {

/// How many letters wide a table's column is: as the longest of its texts, and no narrower than usual.
template <class Rows, class Text>
std::size_t column_width(std::size_t usual, Rows const& rows, Text const& text_of) {
    for (auto const& row : rows) usual = std::max(usual, text_of(row).size());
    return usual;
}

}   // namespace lore
