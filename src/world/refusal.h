#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lore {

// How worlds of foreign code, in libraries and processes, are told off. `called` is "world pendulum short from FILE".

/// Throws Error: it states what breaks a rule.
[[noreturn]] void refuse_world(std::string_view called, std::string_view why, std::string_view remedy);
/// Throws UsageError with the world's own reason.
[[noreturn]] void refuse_settings(std::string_view called, std::string_view reason);
/// Throws Error if `why`, of a check in values.h, is not "". `step`: of the batch, from 0.
void refuse_values(std::string_view called, std::int64_t step, std::string const& why);

}   // namespace lore
