// Builds, asks and derives knowledge bases.
//
//   lore-kb build runs/s1 --out kb1.lorekb
//   lore-kb info kb1.lorekb
//
// The first simulates the lineage of the best individual of runs/s1 again and writes its behavioral features with
// their values; the second shows what came out. docs/manual/formats.md has the columns of the CSV files.

#include "command.h"

#include <lore/experiment/version.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace {

using namespace lore;

constexpr char const* examples =
    "Examples:\n"
    "  lore-kb build runs/s1 --out kb1.lorekb                        from the lineage of the best-of-run\n"
    "  lore-kb build runs/s1 --all --out kb1all.lorekb               from every individual ever evaluated\n"
    "  lore-kb info kb1.lorekb --json\n"
    "  lore-kb query kb1.lorekb --run runs/t1 --csv found.csv        what the best of another run shows of it\n"
    "  lore-kb product kb1.lorekb kb2.lorekb --run runs/s1 --csv product.csv\n"
    "  lore-kb randomize kb1.lorekb --seed 1 --out kb1random.lorekb\n"
    "  lore-kb revalue kb1.lorekb --value return --gamma 0.995 --out kb1return.lorekb\n"
    "  lore-kb reduce kb1.lorekb --top 1000 --out top.lorekb\n"
    "  lore-kb export kb1.lorekb --npy kb1\n"
    "  lore-kb individuals runs/s1 > lineage.jsonl                   ancestors with their genomes, for other programs\n"
    "  lore-kb clone kb1.lorekb --out founders.lore                  for lore-evolve --founders founders.lore\n"
    "  lore-kb verify runs/s1/lineage.lore\n"
    "'lore-kb COMMAND --help' has the options of a command.\n"
    "Exit codes: 0 done, 2 usage, configuration or the name of an input, 1 any other failure.";

int run(int argc, char** argv) {
    kb::Program program;
    program.command_line = fmt::format("lore-kb {}", fmt::join(argv + 1, argv + argc, " "));
    CLI::App app{
        "Builds, asks and derives knowledge bases: behavioral features and the rewards of those who showed them.",
        "lore-kb"};
    app.footer(examples);
    app.set_version_flag("--version", [] { return version_text("lore-kb"); });
    app.require_subcommand(1);
    app.fallthrough();
    app.add_flag("-q,--quiet", program.quiet, "say nothing but errors");
    for (auto const add :
         {kb::add_build, kb::add_info, kb::add_query, kb::add_product, kb::add_randomize, kb::add_revalue,
          kb::add_reduce, kb::add_export, kb::add_individuals, kb::add_clone, kb::add_verify})
        add(app, program);

    if (auto const only = parse_command_line(app, argc, argv)) return *only;
    program.chosen();
    return static_cast<int>(ExitCode::done);
}

}   // namespace

int main(int argc, char** argv) {
    return lore::run_program("lore-kb", [&] { return run(argc, argv); });
}
