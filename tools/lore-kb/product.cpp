#include "command.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/knowledge/product.h>

#include <algorithm>

#include <fmt/format.h>

namespace lore::kb {

namespace {

struct ProductOptions {
    std::vector<std::string> bases;
    std::string run, csv;
    std::optional<std::string> individual;
};

void product(Program const& program, ProductOptions const& options) {
    check_writable(options.csv);
    RunDirectory const run = open_run(options.run);
    Trace const trace = trace_of(run, options.individual.value_or("best"));
    std::vector<Shaper> shapers;
    for (KnowledgeBase& base : read_knowledge_bases(options.bases)) {
        require_channels(base, options.bases[shapers.size()], trace.channels);
        require_length(base.config().window_length, run, options.bases[shapers.size()]);
        shapers.emplace_back(std::move(base));
    }
    std::string csv = "window,step,product";
    for (std::size_t i = 1; i <= shapers.size(); ++i) fmt::format_to(std::back_inserter(csv), ",value_{}", i);
    csv += '\n';
    int const length = shapers.front().base().config().window_length;
    std::vector<Window> const windows = windows_of(trace, length);
    std::vector<FoundValues> values;
    for (Shaper const& shaper : shapers) values.push_back(values_of(shaper, windows));
    std::vector<double> const products = product_of(values);
    for (std::size_t w = 0; w < windows.size(); ++w) {
        fmt::format_to(std::back_inserter(csv), "{},{},{}", w, w * static_cast<std::size_t>(length), products[w]);
        for (FoundValues const& of_base : values)
            fmt::format_to(std::back_inserter(csv), ",{}", of_base[w].value_or(no_feature_value));
        csv += '\n';
    }
    auto const salient = std::count_if(products.begin(), products.end(), [](double product) { return product != 0; });
    write_file_atomically(options.csv, csv);
    say(program,
        fmt::format("wrote {}: {} of {} windows have a product other than 0", options.csv, salient, windows.size()));
}

}   // namespace

void add_product(CLI::App& app, Program& program) {
    auto const options = std::make_shared<ProductOptions>();
    CLI::App* const command =
        add_command(app, program, "product", "Multiply the values of several knowledge bases along an evaluation",
                    options, product);
    command->add_option("KB", options->bases, "one or more knowledge bases")->required();
    command->add_option("--run", options->run, "run whose individual is evaluated")->required();
    add_individual(command, options->individual);
    command->add_option("--csv", options->csv, "file to write: window,step,product,value_1,value_2,...")->required();
}

}   // namespace lore::kb
