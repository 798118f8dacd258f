// Reward shaping by rules that look at everything shown, on any number of ranks and after a stop.

#include "system/evolve_command.h"

#include <lore/archive/knowledge_file.h>

#include <gtest/gtest.h>

using namespace lore;

namespace {

/// A base built from a small source run, whose features get the values -2, -1, 0, 1, 2 in turns: so small a run
/// delivers nothing, and rules have to tell features apart.
void build_valued_base(Scratch const& scratch, std::string const& config, std::string const& path) {
    for (auto const& words : {evolve(config, scratch.file("source")),
                              {program("lore-kb"), "build", scratch.file("source"), "--out", path, "-q"}}) {
        Command command{scratch, words};
        ASSERT_EQ(command.wait(), 0) << command.err();
    }
    KnowledgeBase const base = read_knowledge_base(path);
    std::vector<double> values;
    for (int feature = 0; feature < base.size(); ++feature) values.push_back(feature % 5 - 2);
    write_knowledge_base(path, base.with_values(std::move(values), base.provenance()));
}

}   // namespace

TEST(Shaping, by_share_and_by_negative_values_gives_the_same_run_on_all_ranks_and_after_a_stop) {
    Scratch const scratch;
    std::string const config = small_config(scratch, 20), base = scratch.file("kb.lorekb");
    build_valued_base(scratch, config, base);
    std::vector<std::string> signatures;
    for (std::string const rule : {"share", "max"}) {
        std::vector<std::string> const as{"--kb", base, "--seed", "5", "--set", "shaping.rule=" + rule};
        std::string const straight = scratch.file(rule);
        Command alone{scratch, evolve(config, straight, as)};
        ASSERT_EQ(alone.wait(), 0) << alone.err();
        signatures.push_back(signature(alone));
        for (int const ranks : {1, 2, 3}) {
            std::string const directory = straight + std::to_string(ranks);
            Command command{scratch, std::vector<std::string>{"LORE_TEST_DELAY=2"} + on_ranks(ranks) +
                                         evolve(config, directory, as)};
            EXPECT_EQ(command.wait(), 0) << command.err();
            EXPECT_EQ(signature(command), signatures.back()) << rule << " on " << ranks;
            EXPECT_EQ(results(directory), results(straight)) << rule << " on " << ranks;
        }
        std::string const stopped = straight + "-stopped";
        std::vector<std::string> const resumed = as + std::vector<std::string>{"--resume"};
        Command start{scratch, evolve(config, stopped, as + std::vector<std::string>{"--max-time", "0"})};
        EXPECT_EQ(start.wait(), 75) << start.err();
        Command more{scratch, on_ranks(2) + evolve(config, stopped, resumed)};
        EXPECT_EQ(more.wait(), 0) << more.err();
        EXPECT_EQ(signature(more), signatures.back()) << rule << " after a stop";
        EXPECT_EQ(results(stopped), results(straight)) << rule << " after a stop";
    }
    EXPECT_NE(signatures[0], signatures[1]);
}
