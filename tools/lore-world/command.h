#pragma once

#include "program.h"

#include <lore/world/open.h>

#include <functional>
#include <string>

namespace lore::world {

/// What all subcommands share.
struct Program {
    bool quiet = false;
    std::function<void()> chosen;   ///< the subcommand that the command line asks for
};

/// Which world is meant: WORLD, --config FILE, or both.
struct WorldOptions {
    std::string world, config;
};
void add_world(CLI::App*, WorldOptions&);
/// WORLD with the settings of --config, or the world that --config names. Throws UsageError where there is neither.
WorldRequest request_for(WorldOptions const&);
/// It, or a built-in world.
OpenedWorld open_world(WorldRequest const&);
/// "world pendulum short from ./pendulum.so"
std::string called(OpenedWorld const&);

// One function a subcommand, in the file of its name.
void add_info(CLI::App&, Program&);
void add_check(CLI::App&, Program&);

}   // namespace lore::world
