#include "command.h"

#include <lore/experiment/verification.h>

#include <fmt/format.h>

namespace lore::kb {

namespace {

struct VerifyOptions {
    std::string path;
};

void verify(Program const& program, VerifyOptions const& options) {
    say(program, fmt::format("{}: {}, whole", options.path, lore::verify(options.path)));
}

}   // namespace

void add_verify(CLI::App& app, Program& program) {
    auto const options = std::make_shared<VerifyOptions>();
    CLI::App* const command = add_command(app, program, "verify", "Check any file that Lore writes", options, verify);
    command->add_option("FILE", options->path, "file, or directory of a run")->required();
}

}   // namespace lore::kb
