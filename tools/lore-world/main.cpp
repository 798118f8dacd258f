// Shows what a world offers, and tries whether it keeps its contract (lore/world.h).
//
//   cc -std=c99 -O2 -ffp-contract=off -shared -fPIC -Iinclude docs/examples/pendulum/pendulum.c -o pendulum.so -lm
//   lore-world info ./pendulum.so
//   lore-world check ./pendulum.so
//
// The second line shows sensors, effectors and sizes; the third tries rule after rule, and measures the speed.

#include "command.h"

#include <lore/experiment/version.h>

namespace {

using namespace lore;

constexpr char const* examples =
    "Examples:\n"
    "  lore-world check ./pendulum.so                  a library by its path\n"
    "  lore-world check pendulum                       looked for here, in LORE_WORLD_PATH, in lib/lore/worlds\n"
    "  lore-world info --config pendulum/source.toml   the world of a configuration, with its settings\n"
    "  lore-world check --config cartpole/source.toml  a world in Python: a process\n"
    "  lore-world info ./pendulum.so --config pendulum/target.toml --json\n"
    "  lore-world check collectball:source             a built-in world\n"
    "'lore-world COMMAND --help' has the options of a command.\n"
    "Exit codes: 0 done, 2 usage, configuration or the name of an input, 1 any other failure: a broken rule.";

int run(int argc, char** argv) {
    world::Program program;
    CLI::App app{"Shows what a world offers, and tries whether it keeps its contract.", "lore-world"};
    app.footer(examples);
    app.set_version_flag("--version", [] { return version_text("lore-world"); });
    app.require_subcommand(1);
    app.fallthrough();
    app.add_flag("-q,--quiet", program.quiet, "say nothing but errors");
    world::add_info(app, program);
    world::add_check(app, program);

    if (auto const only = parse_command_line(app, argc, argv)) return *only;
    program.chosen();
    return static_cast<int>(ExitCode::done);
}

}   // namespace

int main(int argc, char** argv) {
    return lore::run_program("lore-world", [&] { return run(argc, argv); });
}
