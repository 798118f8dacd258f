#include "command.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/knowledge_export.h>
#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>

#include <fmt/format.h>

namespace lore::kb {

namespace {

struct ExportOptions {
    std::string base, npy, csv;
};

void export_base(Program const& program, ExportOptions const& options) {
    if (options.npy.empty() == options.csv.empty())
        throw UsageError("cannot export", "one format is needed", "Give either --npy DIR or --csv FILE.");
    KnowledgeBase const base = read_knowledge_base(options.base);
    if (!options.npy.empty()) export_knowledge(options.npy, base);
    else {
        check_writable(options.csv);
        write_file_atomically(options.csv, knowledge_csv(base));
    }
    say(program, fmt::format("wrote {}: {} features", options.npy.empty() ? options.csv : options.npy, base.size()));
}

}   // namespace

void add_export(CLI::App& app, Program& program) {
    auto const options = std::make_shared<ExportOptions>();
    CLI::App* const command =
        add_command(app, program, "export", "Write the features for other programs: exactly one of --npy and --csv",
                    options, export_base);
    add_base(command, options->base);
    command->add_option(
        "--npy", options->npy,
        "directory for features.npy, values.npy, reward_sums.npy, counts.npy, the evidence, provenance.json");
    command->add_option("--csv", options->csv, "file, a row a feature");
}

}   // namespace lore::kb
