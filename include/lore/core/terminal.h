#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lore {

struct TerminalSize {
    std::size_t rows = 24, columns = 80;
};

/// Of the terminal that stderr is; the usual one where it is none, or does not say.
TerminalSize terminal_size();

/// The beginning of a line that a terminal of so many columns shows without wrapping; no character is cut. One that
/// takes two columns counts as one.
std::string cut_to_columns(std::string_view line, std::size_t columns);

}   // namespace lore
