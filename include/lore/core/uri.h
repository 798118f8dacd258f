#pragma once

#include <string>
#include <string_view>

namespace lore {

/// A text as a part of a URI (RFC 3986): bytes other than letters, digits, "-._~" and those of `also` are written as
/// %XX.
std::string percent_encoded(std::string_view text, std::string_view also = "");

}   // namespace lore
