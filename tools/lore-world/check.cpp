#include "command.h"

#include <lore/figure/svg.h>
#include <lore/world/contract.h>
#include <lore/world/library.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace lore::world {

namespace {

constexpr double seconds_of_measuring = 0.1;
constexpr int usual_batch = 16;
constexpr int usual_patience = 60;   ///< [s]

struct CheckOptions {
    WorldOptions world;
    ContractConfig contract;
    /// For one call into a library or one answer of a process [s]; nothing: as the configuration says, or 60.
    std::optional<int> patience;
};

/// Whether the scene can be drawn, as pictures will: inside a document of a size of its own.
RuleReport scene_report(World const& world) {
    std::string const scene = world.scene_svg();
    if (scene.empty()) return {"scene", "none", true};
    std::size_t const first = scene.find_first_not_of(" \t\r\n"), last = scene.find_last_not_of(" \t\r\n");
    if (first == std::string::npos || scene[first] != '<' || scene[last] != '>')
        return {"scene", "it is not one SVG element: it does not begin with '<' and end with '>'", false};
    std::string const why =
        why_no_svg(fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}">{}</svg>)",
                               world.facts().width, world.facts().height, scene));
    if (!why.empty()) return {"scene", "it is no well-formed SVG: " + why, false};
    return {"scene", fmt::format("{} bytes of SVG", scene.size()), true};
}

void print_rule(RuleReport const& rule) {
    fmt::print("  {:11} {:7} {}\n", rule.rule, rule.kept ? "kept" : "BROKEN", rule.finding);
}

void print_sample(World const& world, WorldSample const& sample) {
    fmt::print("seen         a life's rewards add up to {:.6g} .. {:.6g} {}; {} of {} lives were over early\n",
               sample.least_return, sample.most_return, world.facts().reward_unit, sample.ended, sample.lives);
    if (!sample.constant_sensors.empty())
        fmt::print("note         never changed: {}\n", fmt::join(sample.constant_sensors, ", "));
    if (sample.lives > 1 && !sample.effectors_matter) fmt::print("note         effectors changed nothing\n");
}

void print_speed(OpenedWorld const& opened) {
    World const& world = *opened.world;
    bool const is_elsewhere = !opened.origin.command.empty();
    Timekeeper const timekeeper = is_elsewhere ? Timekeeper::wall : Timekeeper::processor;
    int const batch = std::min(usual_batch, world.facts().max_batch);
    double const together = measure_speed(world, batch, seconds_of_measuring, timekeeper),
                 alone = measure_speed(world, 1, seconds_of_measuring, timekeeper);
    fmt::print("speed        {:.3g} million steps a second{} in batches of {} ({:.0f} ns a step and life), "
               "{:.3g} million alone\n",
               together / 1e6, is_elsewhere ? " of wall time" : " of one core", batch, 1e9 / together, alone / 1e6);
}

void check(Program const& program, CheckOptions const& options) {
    WorldRequest request = request_for(options.world);
    if (options.patience) request.patience = *options.patience;
    limit_world_calls(options.patience.value_or(usual_patience));
    OpenedWorld const opened = open_world(request);
    World const& world = *opened.world;
    ContractReport report = check_contract(
        world, [&] { return open_world(request).world; }, options.contract);
    report.rules.push_back(scene_report(world));
    if (!program.quiet) {
        fmt::print("{}\n", called(opened));
        for (RuleReport const& rule : report.rules) print_rule(rule);
        if (report.sample.lives > 0) {
            print_sample(world, report.sample);
            print_speed(opened);
        }
    }
    auto const broken = std::ranges::find(report.rules, false, &RuleReport::kept);
    if (broken == report.rules.end()) return;
    throw Error(fmt::format("{} breaks {} of {} rules", called(opened),
                            std::ranges::count(report.rules, false, &RuleReport::kept), report.rules.size()),
                fmt::format("{}: {}", broken->rule, broken->finding),
                "docs/manual/worlds.md says what each rule asks.");
}

}   // namespace

void add_check(CLI::App& app, Program& program) {
    auto const options = std::make_shared<CheckOptions>();
    CLI::App* const command = app.add_subcommand("check", "Try whether a world keeps its contract, and how fast it is");
    add_world(command, options->world);
    command->add_option("--lives", options->contract.lives, "lives that are tried, each by effectors of its own")
        ->check(CLI::Range(1, most_lives))
        ->capture_default_str();
    command->add_option("--steps", options->contract.steps, "of each life")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->add_option("--seed", options->contract.seed, "of the effectors")
        ->check(seed_digits)
        ->capture_default_str();
    command
        ->add_option("--patience", options->patience,
                     "seconds that one call into a library, or one answer of a process, may take [60, or what the "
                     "configuration says of a process]")
        ->check(CLI::Range(1, 86400));
    command->callback([&program, options] { program.chosen = [&program, options] { check(program, *options); }; });
}

}   // namespace lore::world
