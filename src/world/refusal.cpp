#include "refusal.h"

#include <lore/core/error.h>

#include <fmt/format.h>

namespace lore {

std::string one_line(std::string_view text) {
    std::string line{text};
    for (char& c : line)
        if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = ' ';
    return line;
}

void refuse_world(std::string_view called, std::string_view why, std::string_view remedy) {
    throw Error(fmt::format("cannot use {}", called), why, remedy);
}

void refuse_settings(std::string_view called, std::string_view reason) {
    std::string const line = one_line(reason);
    throw UsageError(fmt::format("{} refuses its settings", called), line.empty() ? "it does not say why" : line,
                     "Correct [world.settings] of the configuration.");
}

void refuse_values(std::string_view called, std::int64_t step, std::string const& why) {
    if (!why.empty())
        throw Error(fmt::format("{} breaks its contract at step {}", called, step), why,
                    "Mend it; 'lore-world check' finds such values.");
}

}   // namespace lore
