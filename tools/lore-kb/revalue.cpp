#include "command.h"

#include <lore/archive/knowledge_file.h>
#include <lore/knowledge/derive.h>

namespace lore::kb {

namespace {

struct RevalueOptions {
    std::string base, out, value;
    std::optional<double> gamma;
    std::optional<double> success;
};

void revalue(Program const& program, RevalueOptions const& options) {
    ValueConfig const value = value_config(options.value, options.gamma, options.success);
    check_writable(options.out, FileKind::knowledge_base);
    write_derived(program, options.out, lore::revalue(read_knowledge_base(options.base), value), {options.base});
}

}   // namespace

void add_revalue(CLI::App& app, Program& program) {
    auto const options = std::make_shared<RevalueOptions>();
    CLI::App* const command =
        add_command(app, program, "revalue", "Value the features by another rule, from the evidence of the build",
                    options, revalue);
    add_base(command, options->base);
    add_value(command, options->value, options->gamma, true);
    command
        ->add_option("--success", options->success,
                     "of contrast: so much reward makes a success; refused where the base was built with another "
                     "number")
        ->check(a_finite_number);
    add_out(command, options->out);
}

}   // namespace lore::kb
