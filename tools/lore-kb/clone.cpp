#include "command.h"

#include <lore/core/checksum.h>
#include <lore/archive/founders_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/core/progress.h>
#include <lore/knowledge/clone.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace lore::kb {

namespace {

using Json = nlohmann::ordered_json;
using Fits = std::vector<EffectorFit>;

struct CloneOptions {
    std::string base, out;
    CloneConfig config;
    bool json = false;
};

std::string const& name_of(Channels const& channels, std::size_t effector) {
    return channels[channels.sensors() + static_cast<int>(effector)].name;
}

Json to_json(Channels const& channels, Fits const& fits) {
    Json json = Json::object();
    for (std::size_t e = 0; e < fits.size(); ++e)
        json[name_of(channels, e)] = {{"cross_entropy", fits[e].cross_entropy},
                                      {"absolute_error", fits[e].absolute_error}};
    return json;
}

void print_fit(Channels const& channels, Clones const& clones) {
    fmt::print("{:<12} {:>20} {:>14} {:>15} {:>14}\n", "effector", "cross-entropy [nats]", "of a constant",
               "absolute error", "of a constant");
    for (std::size_t e = 0; e < clones.fit.size(); ++e)
        fmt::print("{:<12} {:20.4f} {:14.4f} {:15.4f} {:14.4f}\n", name_of(channels, e), clones.fit[e].cross_entropy,
                   clones.constant[e].cross_entropy, clones.fit[e].absolute_error, clones.constant[e].absolute_error);
}

void clone(Program const& program, CloneOptions const& options) {
    check_writable(options.out, FileKind::founders);
    std::string const checksum = checksum_text(checksum_of_file(options.base));
    KnowledgeBase const base = read_knowledge_base(options.base);
    CloneConfig const& config = options.config;
    Channels const& channels = base.config().channels;
    Progress progress{"cloning", config.count, "founders", 50, program.quiet || options.json};
    Clones const clones = lore::clone(base, config, [&](int done) { progress.update(done, ""); });
    Json const origin{{"made_by", made_by(program)},
                      {"base", options.base},
                      {"base_xxh3_64", checksum},
                      {"seed", config.seed},
                      {"count", config.count},
                      {"windows", config.windows},
                      {"window_length", base.config().window_length},
                      {"hidden", config.hidden},
                      {"drawn", clones.all_alike ? "evenly" : "by value"},
                      {"fit", to_json(channels, clones.fit)},
                      {"constant", to_json(channels, clones.constant)}};
    std::string const text = origin.dump(2, ' ', false, Json::error_handler_t::replace);
    write_founders(options.out, {"clones of a knowledge base", text, clones.genomes, world_record(base)});
    if (options.json) return fmt::print("{}\n", text);
    say(program, fmt::format("wrote {}: {} founders, each fitted to {} windows drawn {}", options.out, config.count,
                             config.windows, clones.all_alike ? "evenly, since all values are alike" : "by value"));
    if (!program.quiet) print_fit(channels, clones);
}

}   // namespace

void add_clone(CLI::App& app, Program& program) {
    auto const options = std::make_shared<CloneOptions>();
    CloneConfig& config = options->config;
    CLI::App* const command =
        add_command(app, program, "clone", "Make founders that act as windows of a knowledge base do, drawn by value",
                    options, clone);
    add_base(command, options->base);
    command->add_option("--out", options->out, "founders file to write")->required();
    command->add_option("--count", config.count, "founders")->check(CLI::Range(1, 200000))->capture_default_str();
    command->add_option("--seed", config.seed, "of the draws")->check(seed_digits)->capture_default_str();
    command->add_option("--windows", config.windows, "drawn for each founder, with replacement")
        ->check(CLI::Range(1, most_cloned_steps))
        ->capture_default_str();
    command
        ->add_option("--hidden", config.hidden,
                     "hidden neurons with random input weights; a founder has a connection from each sensor to each "
                     "effector, and one from or to each of them for each hidden neuron")
        ->check(CLI::Range(0, most_hidden))
        ->capture_default_str();
    command->add_flag("--json", options->json, "print how the founders were made, and how well they fit, as JSON");
}

}   // namespace lore::kb
