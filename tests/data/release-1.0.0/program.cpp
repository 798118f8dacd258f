// How many survivors does a generation replace? Evolves in this process alone, keeps no files, and prints a row a
// generation: how many of the survivors were born in it, how many share all objectives with another, and the fronts.
//
//   newcomers jobs/tasks/source.toml 1 evolution.generations=1000 evolution.ties=older > newcomers.csv
//   newcomers jobs/tasks/target.toml 1 --kb kb1.lorekb > newcomers.csv
#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/evolution/summary.h>
#include <lore/experiment/run_world.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace {

/// Survivors that were born in the generation reported.
auto newcomers(lore::GenerationReport const& report) {
    auto const& members = report.state->population.members;
    return std::count_if(members.begin(), members.end(), [&](lore::Individual const& member) {
        return member.id().generation == static_cast<std::uint32_t>(report.generation);
    });
}

std::uint64_t seed_of(std::string const& text) {
    std::uint64_t seed = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc{} || end != text.data() + text.size())
        throw lore::UsageError("cannot take the seed " + text, "it is no whole number", "Give one, such as 1.");
    return seed;
}

void evolve(std::string const& config_path, std::uint64_t seed, std::string const& knowledge,
            std::vector<std::string> const& settings) {
    lore::ExperimentConfig config = lore::read_config(config_path, settings);
    std::optional<lore::Shaper> shaper;
    if (!knowledge.empty()) {
        shaper.emplace(lore::read_knowledge_base(knowledge));
        config.evolution.use_shaping = true;
    }
    lore::RunWorld const world = lore::open_run_world(config, lore::arena_text_of(config));
    config.evolution.interface = world.record().interface();
    lore::SerialEvaluator evaluator{{world.world, config.episode, shaper}};
    std::puts("generation,newcomers,tied,fronts");
    lore::EvolutionState const last =
        lore::evolve(config.evolution, seed, evaluator, {}, [](lore::GenerationReport const& report) {
            lore::GenerationSummary const summary = lore::summarize(report);
            std::printf("%d,%td,%d,%d\n", summary.generation, newcomers(report), summary.tied, summary.fronts);
            return true;   // go on
        });
    std::fprintf(stderr, "signature: %s\n", last.signature.text().c_str());
}

}   // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fputs("newcomers: CONFIG SEED [--kb FILE] [SECTION.KEY=VALUE ...]\n", stderr);
        return 2;
    }
    std::vector<std::string> settings{argv + 3, argv + argc};
    std::string knowledge;
    if (settings.size() >= 2 && settings[0] == "--kb") {
        knowledge = settings[1];
        settings.erase(settings.begin(), settings.begin() + 2);
    }
    try {
        evolve(argv[1], seed_of(argv[2]), knowledge, settings);
    } catch (lore::Error const& error) {
        std::fprintf(stderr, "newcomers: %s\n", error.what());
        return static_cast<int>(error.exit_code());
    }
}
