// Stands in for lore-kb in the campaign's tests: checks that what it is to read is there, writes a tiny knowledge base.

#include <lore/archive/knowledge_file.h>
#include <lore/collectball/collectball.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

int main(int argc, char** argv) {
    std::vector<std::string> const arguments(argv + 1, argv + argc);
    std::set<std::string> const options{"--seed", "--top", "--value", "--gamma", "--success"};   // with a value
    std::string out;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        if (arguments[i] == "--out") {
            out = arguments[++i];
            continue;
        }
        if (arguments[i] == "--gammas") {
            while (i + 1 < arguments.size() && !arguments[i + 1].starts_with("--")) ++i;
            continue;
        }
        if (options.contains(arguments[i])) {
            ++i;
            continue;
        }
        if (!arguments[i].starts_with("--") && !std::filesystem::exists(arguments[i])) {
            std::fprintf(stderr, "lore-kb: cannot read %s (no such file). Check the path.\n", arguments[i].c_str());
            return 1;
        }
    }
    struct Memory {
        std::vector<std::uint16_t> bits = std::vector<std::uint16_t>(20);
        std::vector<float> windows = std::vector<float>(120);
        std::vector<double> values{3}, sums{6};
        std::vector<std::uint32_t> counts{2};
    };
    auto const memory = std::make_shared<Memory>();
    lore::KnowledgeBase::Parts parts;
    parts.config.channels = lore::collectball_channels();
    parts.provenance.kind = arguments[0] == "randomize" ? "random" : arguments[0] == "reduce" ? "reduced" : "lineage";
    for (auto const& word : arguments)
        if (word == "--all") parts.provenance.kind = "all";
    parts.provenance.individuals = 2;
    parts.provenance.windows = 400;
    parts.bits = memory->bits;
    parts.windows = memory->windows;
    parts.values = memory->values;
    parts.reward_sums = memory->sums;
    parts.counts = memory->counts;
    parts.keep_alive = memory;
    lore::write_knowledge_base(out, lore::KnowledgeBase{parts});
    return 0;
}
