#include <lore/core/utf8.h>

#include <algorithm>

namespace lore {

std::size_t printable_bytes(std::string_view text) {
    auto const byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    unsigned const first = byte(0);
    if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
    std::size_t const length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    // The least and the most that the second byte may be: with less the form would be too long, or a control character.
    unsigned least = 0x80, most = 0xbf;
    switch (first) {
    case 0xc2: least = 0xa0; break;
    case 0xe0: least = 0xa0; break;
    case 0xed: most = 0x9f; break;   // surrogates
    case 0xf0: least = 0x90; break;
    case 0xf4: most = 0x8f; break;   // U+10FFFF
    default: break;
    }
    if (first < 0xc2 || first > 0xf4 || byte(1) < least || byte(1) > most) return 0;
    for (std::size_t i = 2; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    return length;
}

bool is_printable(std::string_view text) {
    while (std::size_t const length = printable_bytes(text)) text.remove_prefix(length);
    return text.empty();
}

std::string harmless(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        std::size_t const length = printable_bytes(text);
        if (length == 0) out += '?';
        else out += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(1, length));
    }
    return out;
}

}   // namespace lore
