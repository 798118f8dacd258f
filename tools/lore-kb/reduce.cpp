#include "command.h"

#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/knowledge/derive.h>

namespace lore::kb {

namespace {

struct ReduceOptions {
    std::string base, out;
    std::optional<int> top, least_count;
    std::optional<double> least_value;
    std::vector<std::string> consensus;
};

void reduce(Program const& program, ReduceOptions const& options) {
    int const rules = options.top.has_value() + options.least_value.has_value() + options.least_count.has_value() +
                      !options.consensus.empty();
    if (rules != 1)
        throw UsageError("cannot reduce", "one rule is needed",
                         "Give one of --top, --min-value, --min-count and --consensus.");
    check_writable(options.out, FileKind::knowledge_base);
    KnowledgeBase const base = read_knowledge_base(options.base);
    auto const write = [&](KnowledgeBase const& derived, std::vector<std::string> const& sources) {
        write_derived(program, options.out, derived, sources);
    };
    if (options.top) return write(keep_top(base, *options.top), {options.base});
    if (options.least_value) return write(keep_valued(base, *options.least_value), {options.base});
    if (options.least_count) return write(keep_shown(base, *options.least_count), {options.base});
    std::vector<KnowledgeBase> others;
    std::vector<std::string> sources{options.base};
    for (std::string const& path : options.consensus) {
        others.push_back(read_knowledge_base(path));
        sources.push_back(path);
    }
    write(keep_consensus(base, others), sources);
}

}   // namespace

void add_reduce(CLI::App& app, Program& program) {
    auto const options = std::make_shared<ReduceOptions>();
    CLI::App* const command =
        add_command(app, program, "reduce",
                    "Keep some of the features: by exactly one of --top, --min-value, --min-count and --consensus",
                    options, reduce);
    add_base(command, options->base);
    command->add_option("--top", options->top, "this many of highest value")->check(CLI::Range(1, 1000000000));
    command->add_option("--min-value", options->least_value, "those of at least this value")->check(a_number);
    command->add_option("--min-count", options->least_count, "those that at least so many individuals have shown")
        ->check(CLI::Range(1, 1000000000));
    command->add_option("--consensus", options->consensus,
                        "those that each of one or more other knowledge bases knows");
    add_out(command, options->out);
}

}   // namespace lore::kb
