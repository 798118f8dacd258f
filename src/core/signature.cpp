#include <lore/core/signature.h>

#include <fmt/format.h>

namespace lore {

std::string Signature::text() const { return fmt::format("{:016x}", value_); }

}   // namespace lore
