#include "command.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/knowledge_export.h>
#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/knowledge/shaping.h>

#include <fmt/format.h>

#include <cmath>

namespace lore::kb {

namespace {

struct QueryOptions {
    std::string base, run, windows, csv, index = "exact";
    std::optional<int> checks;
    std::optional<std::string> individual;
};

void query(Program const& program, QueryOptions const& options) {
    if (options.run.empty() == options.windows.empty())
        throw UsageError("cannot query", "one source of windows is needed",
                         "Give either --run DIR or --windows FILE.npy.");
    if (options.individual && options.run.empty())
        throw UsageError("cannot query", "--individual is of a run", "Give --run DIR, or leave it out.");
    check_writable(options.csv);
    KnowledgeBase const base = read_knowledge_base(options.base);
    int const length = base.config().window_length;
    auto const trace_of_run = [&] {
        RunDirectory const run = open_run(options.run);
        require_length(length, run, options.base);
        return trace_of(run, options.individual.value_or("best"));
    };
    Trace const trace = options.run.empty() ? read_windows(options.windows, base.config()) : trace_of_run();
    require_channels(base, options.base, trace.channels);
    Shaper const shaper{base, ShapingRule::max, index_choice(options.index, options.checks)};
    auto reader = shaper.reader();
    std::string csv = "window,step,feature,distance,value,count\n";
    int row = 0, found = 0;
    for (Window const& window : windows_of(trace, length)) {
        Match const match = reader.match(window);
        found += match.found();
        if (match.found())
            fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{}\n", row, row * length, match.feature,
                           std::sqrt(match.squared_distance), base.value(match.feature), base.count(match.feature));
        else fmt::format_to(std::back_inserter(csv), "{},{},-1,inf,-1,0\n", row, row * length);
        ++row;
    }
    write_file_atomically(options.csv, csv);
    say(program, fmt::format("wrote {}: {} of {} windows are in the knowledge base", options.csv, found, row));
}

}   // namespace

void add_query(CLI::App& app, Program& program) {
    auto const options = std::make_shared<QueryOptions>();
    CLI::App* const command =
        add_command(app, program, "query", "Look windows up: of exactly one of --run and --windows", options, query);
    add_base(command, options->base);
    command->add_option("--run", options->run, "windows of an individual of this run");
    add_individual(command, options->individual);
    command->add_option("--windows", options->windows,
                        "windows from an NPY file, shape (n, T, C) or (n, C T), C channels");
    add_index(command, options->index, options->checks);
    command->add_option("--csv", options->csv, "file to write: window,step,feature,distance,value,count")->required();
}

}   // namespace lore::kb
