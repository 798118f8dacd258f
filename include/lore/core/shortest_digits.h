#pragma once

#include <charconv>
#include <iterator>

namespace lore {

/// The double whose shortest digits are the float's: 3.3, not 3.2999999523162842. For JSON, whose numbers are doubles:
/// more digits would pretend to know more. Reads back to the same float. `value` must be finite.
inline double shortest_digits(float value) {
    char digits[32];
    char const* const end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
    double widened = 0;
    std::from_chars(digits, end, widened);
    return widened;
}

}   // namespace lore
