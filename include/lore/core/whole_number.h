#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace lore {

/// Whether a number is told without a decimal point: whole, and small enough that no digit is lost.
inline bool is_whole(double value) { return std::abs(value) < 1e15 && value == std::round(value); }

/// A number as a value of nlohmann::json, without a decimal point where it is whole.
template <class Json>
Json json_number(double value) {
    if (is_whole(value)) return static_cast<std::int64_t>(value);
    return value;
}

/// The whole number that a value of nlohmann::json holds. Throws std::out_of_range if it is none or beyond the type's
/// range: json itself would convert 1e300 to an int, which C++ does not define, and cut 2^40 to one silently.
/// (What is no number is not shown: it may be nested so deeply that writing it exhausts the stack.)
template <class Integer, class Json>
Integer whole_number(Json const& json) {
    if (json.is_number_unsigned()) {
        if (auto const value = json.template get<std::uint64_t>(); std::in_range<Integer>(value))
            return static_cast<Integer>(value);
    } else if (json.is_number_integer()) {
        if (auto const value = json.template get<std::int64_t>(); std::in_range<Integer>(value))
            return static_cast<Integer>(value);
    }
    std::string shown{"a value of type "};
    if (json.is_number()) shown = json.dump();
    else shown.append(json.type_name());
    throw std::out_of_range(shown.append(" is not a whole number of the range expected"));
}

/// For nlohmann::json::parse, of a stranger's document: writing a value calls itself for each that it holds, and must
/// not exhaust the stack. Throws std::out_of_range.
template <class Json>
bool refuse_deep_nesting(int depth, typename Json::parse_event_t, Json&) {
    if (depth > 64) throw std::out_of_range("it is nested too deeply");
    return true;
}

}   // namespace lore
