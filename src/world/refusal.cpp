#include "refusal.h"

#include <lore/core/error.h>

#include <fmt/format.h>

namespace lore {

void refuse_world(std::string_view called, std::string_view why, std::string_view remedy) {
    throw Error(fmt::format("cannot use {}", called), why, remedy);
}

void refuse_settings(std::string_view called, std::string_view reason) {
    throw UsageError(fmt::format("{} refuses its settings", called), reason.empty() ? "it does not say why" : reason,
                     "Correct [world.settings] of the configuration.");
}

void refuse_values(std::string_view called, std::int64_t step, std::string const& why) {
    if (!why.empty())
        throw Error(fmt::format("{} breaks its contract at step {}", called, step), why,
                    "Mend it; 'lore-world check' finds such values.");
}

}   // namespace lore
