#pragma once

#include <span>
#include <string_view>

namespace lore {

/// An arena file of jobs/tasks/arenas that is compiled in, so that programs find it wherever they are started.
struct BuiltinArena {
    std::string_view name;
    std::string_view text;
};

std::span<BuiltinArena const> builtin_arenas();

}   // namespace lore
