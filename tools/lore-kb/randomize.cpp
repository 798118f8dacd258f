#include "command.h"

#include <lore/archive/knowledge_file.h>
#include <lore/knowledge/derive.h>

namespace lore::kb {

namespace {

struct RandomizeOptions {
    std::string base, out;
    std::uint64_t seed = 0;
    bool permute = false;
};

void randomize(Program const& program, RandomizeOptions const& options) {
    check_writable(options.out, FileKind::knowledge_base);
    KnowledgeBase const base = read_knowledge_base(options.base);
    write_derived(program, options.out,
                  options.permute ? permute(base, options.seed) : lore::randomize(base, options.seed), {options.base});
}

}   // namespace

void add_randomize(CLI::App& app, Program& program) {
    auto const options = std::make_shared<RandomizeOptions>();
    CLI::App* const command =
        add_command(app, program, "randomize", "Replace the values by random ones ('KB random')", options, randomize);
    add_base(command, options->base);
    command->add_option("--seed", options->seed, "of the random values")->required()->check(seed_digits);
    command->add_flag("--permute", options->permute,
                      "shuffle the values among the features, which keeps equal ones equal; without it, values are "
                      "drawn between the smallest and the largest");
    add_out(command, options->out);
}

}   // namespace lore::kb
