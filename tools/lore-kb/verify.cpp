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
    CLI::App* const command = add_command(
        app, program, "verify",
        "Check a run or a file of it, a knowledge base, a founders file, a table (CSV), JSON or NPY", options, verify);
    command
        ->add_option("FILE", options->path, "file, or directory of a run; packs are checked by 'lore-campaign verify'")
        ->required();
}

}   // namespace lore::kb
