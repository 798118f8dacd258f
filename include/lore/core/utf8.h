#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lore {

/// Bytes of the UTF-8 character at the start of the text: 0 if there is none (RFC 3629: no longer form than needed, no
/// surrogate, nothing above U+10FFFF), or if it is a control character (U+0000 to U+001F, U+007F to U+009F).
std::size_t printable_bytes(std::string_view text);

/// Whether all of it is such characters; of an empty text too.
bool is_printable(std::string_view text);

/// Text as a terminal may show it: control characters, which could steer the terminal, and what is no UTF-8 become '?'.
std::string harmless(std::string_view text);

}   // namespace lore
