#include <lore/core/uri.h>

#include <fmt/format.h>

namespace lore {

std::string percent_encoded(std::string_view text, std::string_view also) {
    constexpr std::string_view marks = "-._~";
    std::string encoded;
    for (char const c : text) {
        bool const letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        bool const plain = letter || marks.find(c) != marks.npos || also.find(c) != also.npos;
        encoded += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return encoded;
}

}   // namespace lore
