#include "support/program.h"
#include "support/small_run.h"

#include <lore/collectball/collectball.h>
#include <lore/archive/founders_file.h>
#include <lore/archive/genome_file.h>
#include <lore/archive/knowledge_file.h>
#include <lore/archive/npy_file.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <regex>
#include <sstream>

using namespace lore;
using lore::test::Ran;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace {

/// A run of its own, and lore-kb in its directory.
class LoreKb : public test::ProgramTest {
protected:
    LoreKb() : ProgramTest(LORE_KB) { test::write_small_run(scratch.file("run")); }

    /// What `lore-kb individuals` prints: a header, then an object an individual.
    std::vector<nlohmann::json> individuals_of(std::string const& file) {
        Ran const ran = run("individuals " + file);
        EXPECT_EQ(ran.exit_code, 0) << ran.errors;
        std::istringstream stream{ran.output};
        std::vector<nlohmann::json> lines;
        for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
        return lines;
    }
    static Genome genome_of(nlohmann::json const& individual) {
        Genome genome{Interface{collectball_channels()}};
        for (auto const& [source, target, gene] :
             individual.at("edges").get<std::vector<std::tuple<NeuronIndex, NeuronIndex, float>>>())
            genome.edges.push_back({source, target, gene});
        genome.biases = individual.at("biases").get<std::vector<float>>();
        return genome;
    }
    std::vector<std::string> lines_of(std::string const& file) {
        std::ifstream stream{scratch.file(file)};
        std::vector<std::string> lines;
        for (std::string line; std::getline(stream, line);) lines.push_back(line);
        return lines;
    }
};

}   // namespace

TEST_F(LoreKb, builds_tells_and_verifies) {
    expect_done("build run --out kb.lorekb");
    KnowledgeBase const base = read_knowledge_base(scratch.file("kb.lorekb"));
    EXPECT_GT(base.size(), 0);
    EXPECT_THAT(base.provenance().made_by, HasSubstr("lore-kb build run --out kb.lorekb"));

    auto const told = nlohmann::json::parse(run("info kb.lorekb --json").output);
    EXPECT_EQ(told.at("features"), base.size());
    EXPECT_EQ(told.at("window_length"), 20);
    EXPECT_EQ(told.at("provenance").at("kind"), "lineage");
    EXPECT_THAT(run("info kb.lorekb").output, HasSubstr("features     " + std::to_string(base.size())));

    expect_done("export kb.lorekb --npy kb");
    expect_done("export kb.lorekb --csv kb.csv");
    for (char const* file : {"kb.lorekb", "run/lineage.lore", "run/all.lore", "run/config.toml", "run/arena.toml",
                             "run/progress.csv", "run", "kb/counts.npy", "kb/provenance.json", "kb.csv"})
        EXPECT_THAT(run(std::string{"verify "} + file).output, HasSubstr("whole")) << file;
    std::filesystem::resize_file(scratch.file("kb.csv"), std::filesystem::file_size(scratch.file("kb.csv")) - 9);
    expect_refusal("verify kb.csv", 1, "its last line was cut");
    Manifest manifest = read_manifest(scratch.file("run/manifest.json"));
    manifest.outputs = {{"output", "/etc/passwd", 1, "0123456789abcdef"}};
    std::filesystem::create_directory(scratch.file("other"));
    write_manifest(scratch.file("other/manifest.json"), manifest);
    manifest.outputs.back().path = "../run/config.toml";
    expect_refusal("verify other/manifest.json", 1, "outside of its directory, '/etc/passwd'");
    write_manifest(scratch.file("other/manifest.json"), manifest);
    expect_refusal("verify other/manifest.json", 1, "outside of its directory, '../run/config.toml'");
    std::filesystem::resize_file(scratch.file("kb/provenance.json"), 30);
    expect_refusal("verify kb/provenance.json", 1, "no JSON document");
    for (char const* file : {"lineage.lore", "arena.toml"}) {
        std::filesystem::rename(scratch.file(std::string{"run/"} + file), scratch.file("aside"));
        expect_refusal("verify run", 1, std::string{file});
        std::filesystem::rename(scratch.file("aside"), scratch.file(std::string{"run/"} + file));
    }
}

TEST_F(LoreKb, refuses_windows_and_bounds_that_nothing_could_read) {
    expect_refusal("build run --window-length 401 --out never", 2, "an evaluation of this run has 400");
    expect_refusal("build run --window-length 4001 --out never", 2, "4000");
    expect_refusal("build run --threshold nan --out never", 2, "'nan' is no number");
    expect_refusal("build run --all --individual 6.0 --out never", 2, "--all takes everybody");
    expect_refusal("query kb.lorekb --windows w.npy --individual 6.0 --csv never", 2, "--individual is of a run");
    expect_refusal("build run --out ''", 2, "--out is empty");
    expect_refusal("biuld run --out never", 2, "'biuld' was not expected");
    expect_done("build run --out kb.lorekb");
    expect_refusal("reduce kb.lorekb --top 0 --out never", 2, "--top");
    expect_refusal("reduce kb.lorekb --top -1 --out never", 2, "not in range 1 to 1000000000");
    expect_refusal("reduce kb.lorekb --min-value nan --out never", 2, "'nan' is no number");
    expect_refusal("randomize kb.lorekb --seed -1 --out never", 2, "no whole number from 0");
}

TEST_F(LoreKb, builds_from_everybody_and_from_another_individual) {
    expect_done("build run --all --out all.lorekb -q");
    EXPECT_EQ(read_knowledge_base(scratch.file("all.lorekb")).provenance().individuals, 64u);
    expect_done("build run --all --every 5 --out all.lorekb -q");
    EXPECT_EQ(read_knowledge_base(scratch.file("all.lorekb")).provenance().individuals, 13u);
    expect_refusal("build run --every 5 --out x.lorekb", 2, "--all");
    expect_done("build run --individual 6.0 --window-length 10 --threshold 1 --out other.lorekb");
    EXPECT_EQ(read_knowledge_base(scratch.file("other.lorekb")).config(),
              (KnowledgeConfig{10, 1.0f, collectball_channels()}));
    expect_refusal("build run --individual 99.0 --out x.lorekb", 2, "99.0");
    expect_refusal("build run --individual best-of --out x.lorekb", 2, "GENERATION.SLOT");
}

TEST_F(LoreKb, clones_founders_and_says_how_well_they_fit) {
    expect_done("build run --out kb.lorekb -q");
    Ran const told = run("clone kb.lorekb --count 3 --windows 20 --seed 1 --out a.lore");
    EXPECT_EQ(told.exit_code, 0) << told.errors;
    EXPECT_THAT(told.output, HasSubstr("wrote a.lore: 3 founders, each fitted to 20 windows"));
    EXPECT_THAT(told.output, HasSubstr("left_wheel"));
    EXPECT_THAT(told.output, HasSubstr("cross-entropy [nats]"));
    auto const json = nlohmann::json::parse(
        run("clone kb.lorekb --count 3 --windows 20 --seed 1 --hidden 2 --out hidden.lore --json").output);
    EXPECT_EQ(json.at("hidden"), 2);
    EXPECT_LE(json.at("fit").at("collect").at("cross_entropy"), json.at("constant").at("collect").at("cross_entropy"));
    FoundersFile const founders = read_founders(scratch.file("a.lore"));
    EXPECT_EQ(founders.genomes.size(), 3u);
    EXPECT_THAT(founders.origin, HasSubstr("\"base\": \"kb.lorekb\""));
    EXPECT_EQ(read_founders(scratch.file("hidden.lore")).genomes[0].hidden_count(), 2);
    EXPECT_THAT(run("verify a.lore").output,
                HasSubstr("founders file of 3 genomes: clones of a knowledge base, whole"));

    expect_done("clone kb.lorekb --count 3 --windows 20 --seed 1 --out again.lore");
    expect_done("clone kb.lorekb --count 3 --windows 20 --seed 2 --out other.lore");
    EXPECT_EQ(read_founders(scratch.file("again.lore")).genomes, founders.genomes);
    EXPECT_NE(read_founders(scratch.file("other.lore")).genomes, founders.genomes);
}

TEST_F(LoreKb, refuses_clones_that_cannot_be) {
    expect_refusal("clone missing.lorekb --out never", 2, "missing.lorekb");
    expect_done("build run --out kb.lorekb -q");
    expect_refusal("clone kb.lorekb --count 0 --out never", 2, "--count");
    expect_refusal("clone kb.lorekb --count 200001 --out never", 2, "--count");
    expect_refusal("clone kb.lorekb --hidden 65 --out never", 2, "--hidden");
    expect_refusal("clone kb.lorekb --windows 50001 --out never", 2, "Ask for 1 to 50000");
    expect_refusal("clone kb.lorekb --seed -1 --out never", 2, "no whole number from 0");
    expect_refusal("clone kb.lorekb --out nowhere/never", 2, "there is no directory nowhere");
    expect_done("reduce kb.lorekb --min-value 1000 --out empty.lorekb");
    expect_refusal("clone empty.lorekb --out never", 2, "no features");
}

TEST_F(LoreKb, finds_every_window_of_the_lineage_in_its_own_base) {
    expect_done("build run --out kb.lorekb");
    expect_done("query kb.lorekb --run run --csv found.csv");
    std::vector<std::string> const lines = lines_of("found.csv");
    ASSERT_EQ(lines.size(), 1u + 400 / 20);
    EXPECT_EQ(lines[0], "window,step,feature,distance,value,count");
    EXPECT_THAT(lines[1], StartsWith("0,0,0,0,"));   // the best-of-run's first window is feature 0
    for (std::string const& line : lines) EXPECT_EQ(line.find(",-1,"), std::string::npos);
}

TEST_F(LoreKb, queries_windows_of_an_npy_file) {
    expect_done("build run --out kb.lorekb");
    std::vector<float> windows(2 * 300, 0.0f);
    std::fill(windows.begin() + 300, windows.end(), 1.0f);   // everything at once: surely unknown
    write_npy(scratch.file("w.npy"), windows, std::array<std::size_t, 2>{2, 300});
    expect_done("query kb.lorekb --windows w.npy --csv found.csv");
    EXPECT_EQ(lines_of("found.csv").at(2), "1,20,-1,inf,-1,0");
    windows[7] = std::numeric_limits<float>::quiet_NaN();
    write_npy(scratch.file("w.npy"), windows, std::array<std::size_t, 2>{2, 300});
    expect_refusal("query kb.lorekb --windows w.npy --csv found.csv", 1, "not finite");
    expect_refusal("query kb.lorekb --csv found.csv", 2, "--windows");
}

TEST_F(LoreKb, exports_what_query_reads_back_whatever_the_index) {
    expect_done("build run --out kb.lorekb --index flann");
    EXPECT_EQ(read_knowledge_base(scratch.file("kb.lorekb")).provenance().index, "flann");
    expect_done("build run --out few.lorekb --index flann --checks 8");
    EXPECT_EQ(read_knowledge_base(scratch.file("few.lorekb")).provenance().index, "flann with 8 checks");
    expect_refusal("build run --out never --checks 8", 2, "the exact index has no --checks");
    expect_refusal("build run --out never --index flann --checks 0", 2, "--checks");
    expect_done("export kb.lorekb --npy exported");
    expect_done("query kb.lorekb --windows exported/features.npy --csv found.csv --index exact");
    std::vector<std::string> const lines = lines_of("found.csv");
    for (std::size_t i = 1; i < lines.size(); ++i)
        EXPECT_THAT(lines[i], HasSubstr(std::to_string(i - 1) + ",0,"));   // itself, at distance 0
    expect_done("export kb.lorekb --csv kb.csv");
    EXPECT_EQ(lines_of("kb.csv").size(), lines.size());
    EXPECT_TRUE(std::filesystem::exists(scratch.file("exported/news.npy")));
    expect_done("export " LORE_SOURCE_DIR "/tests/data/version-1/sample.lorekb --npy exported");
    EXPECT_FALSE(std::filesystem::exists(scratch.file("exported/news.npy"))) << "of another base";
}

TEST_F(LoreKb, prints_the_lineage_with_its_genomes_to_the_bit) {
    LineageArchive const lineage = read_lineage(scratch.file("run/lineage.lore"));
    auto const lines = individuals_of("run");
    EXPECT_EQ(individuals_of("run/lineage.lore"), lines);
    auto const& header = lines.at(0);
    EXPECT_EQ(header.at("format"), 1);
    EXPECT_EQ(header.at("kind"), "lineage archive");
    EXPECT_EQ(header.at("individuals"), lineage.births.size());
    EXPECT_EQ(header.at("generation"), 6);
    EXPECT_EQ(header.at("best"), text(lineage.best));
    EXPECT_EQ(header.at("last_population").size(), 8u);
    EXPECT_EQ(header.at("last_population").at(7), text(lineage.last_population.at(7)));
    EXPECT_EQ(header.at("inputs"), 12);
    EXPECT_EQ(header.at("outputs"), 3);
    EXPECT_FALSE(header.contains("founders"));
    ASSERT_EQ(lines.size(), 1 + lineage.births.size());
    for (std::size_t i = 0; i < lineage.births.size(); ++i) {
        Birth const& birth = *lineage.births[i];
        auto const& line = lines[i + 1];
        EXPECT_EQ(line.at("id"), text(birth.id));
        EXPECT_EQ(line.at("parent"), birth.parent ? nlohmann::json(text(birth.parent->id)) : nlohmann::json{});
        EXPECT_EQ(line.at("balls"), birth.reward);
        EXPECT_EQ(line.at("shaping"), birth.shaping);
        EXPECT_EQ(line.at("diversity"), birth.diversity);
        EXPECT_EQ(genome_of(line), birth.genome);
    }
}

TEST_F(LoreKb, prints_where_founders_of_a_lineage_came_from) {
    LineageArchive const lineage = read_lineage(scratch.file("run/lineage.lore"));
    Population population;
    for (IndividualId const id : lineage.last_population) population.members.emplace_back().birth = lineage.find(id);
    write_lineage(scratch.file("other.lore"), population, lineage.world,
                  FoundersOrigin{"clones", "a \"b\"\xff.lore", "0123"});
    auto const founders = individuals_of("other.lore").at(0).at("founders");
    EXPECT_EQ(founders.at("kind"), "clones");
    EXPECT_EQ(founders.at("path"), "a \"b\"\xef\xbf\xbd.lore");   // what is no UTF-8 is replaced
    EXPECT_EQ(founders.at("xxh3_64"), "0123");
}

TEST_F(LoreKb, prints_everybody_founders_and_a_failed_individual) {
    auto const everybody = individuals_of("run/all.lore");
    EXPECT_EQ(everybody.at(0).at("kind"), "archive of all individuals");
    EXPECT_EQ(everybody.at(0).at("individuals"), 64);
    ASSERT_EQ(everybody.size(), 65u);
    EXPECT_EQ(everybody.at(1).at("id"), "0.0");
    EXPECT_EQ(everybody.at(64).at("id"), "6.7");
    EXPECT_FALSE(everybody.at(64).contains("shaping"));
    LineageArchive const lineage = read_lineage(scratch.file("run/lineage.lore"));
    auto const best = std::find_if(everybody.begin() + 1, everybody.end(),
                                   [&](auto const& one) { return one.at("id") == text(lineage.best); });
    ASSERT_NE(best, everybody.end());
    EXPECT_EQ(genome_of(*best), lineage.find(lineage.best)->genome);

    expect_done("build run --out kb.lorekb -q");
    expect_done("clone kb.lorekb --count 2 --windows 20 --out founders.lore -q");
    auto const founders = individuals_of("founders.lore");
    EXPECT_EQ(founders.at(0).at("founders"), "clones of a knowledge base");
    EXPECT_EQ(founders.at(0).at("origin").at("base"), "kb.lorekb");
    EXPECT_EQ(genome_of(founders.at(2)), read_founders(scratch.file("founders.lore")).genomes.at(1));

    write_genome(scratch.file("failed.lore"),
                 {{3, 5}, lineage.births.front()->genome, 1, "it \"failed\"", lineage.world});
    auto const failed = individuals_of("failed.lore");
    EXPECT_EQ(failed.at(0).at("reason"), "it \"failed\"");
    EXPECT_EQ(failed.at(1).at("id"), "3.5");
    EXPECT_EQ(genome_of(failed.at(1)), lineage.births.front()->genome);
}

TEST_F(LoreKb, prints_no_individual_of_what_has_none_or_is_damaged) {
    expect_refusal("individuals nowhere", 2, "nowhere");
    expect_done("build run --out kb.lorekb -q");
    expect_refusal("individuals kb.lorekb", 1, "it is a knowledge base");
    for (char const* file : {"lineage.lore", "all.lore"}) {
        std::string const path = scratch.file(std::string{"run/"} + file);
        std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
        expect_refusal(std::string{"individuals run/"} + file, 1, file);
    }
    std::filesystem::remove(scratch.file("run/lineage.lore"));
    expect_refusal("individuals run", 2, "run/lineage.lore");
}

TEST_F(LoreKb, derives_and_multiplies) {
    expect_done("build run --out kb.lorekb");
    expect_done("randomize kb.lorekb --seed 3 --out random.lorekb");
    expect_done("randomize kb.lorekb --permute --seed 3 --out permuted.lorekb");
    KnowledgeBase const permuted = read_knowledge_base(scratch.file("permuted.lorekb"));
    EXPECT_EQ(permuted.provenance().kind, "permuted");
    EXPECT_THAT(permuted.provenance().derivation.back(), HasSubstr("shuffled with seed 3"));
    expect_done("reduce random.lorekb --top 2 --out top.lorekb");
    KnowledgeBase const top = read_knowledge_base(scratch.file("top.lorekb"));
    EXPECT_EQ(top.size(), 2);
    EXPECT_EQ(top.provenance().derivation.size(), 4u);
    expect_done("reduce kb.lorekb --consensus top.lorekb --out both.lorekb");
    EXPECT_GE(read_knowledge_base(scratch.file("both.lorekb")).size(), 2);
    KnowledgeBase const base = read_knowledge_base(scratch.file("kb.lorekb"));
    std::span<std::uint32_t const> const counts = base.parts().counts;
    std::uint32_t const most = *std::max_element(counts.begin(), counts.end());
    expect_done("reduce kb.lorekb --min-count " + std::to_string(most) + " --out shown.lorekb");
    EXPECT_EQ(read_knowledge_base(scratch.file("shown.lorekb")).size(), std::count(counts.begin(), counts.end(), most));
    expect_done("reduce kb.lorekb --min-count " + std::to_string(most + 1) + " --out shown.lorekb");
    EXPECT_EQ(read_knowledge_base(scratch.file("shown.lorekb")).size(), 0);
    expect_done("product kb.lorekb top.lorekb --run run --csv product.csv");
    EXPECT_EQ(lines_of("product.csv").at(0), "window,step,product,value_1,value_2");
    expect_refusal("reduce kb.lorekb --out x.lorekb", 2, "--top");
    expect_refusal("reduce kb.lorekb --top 3 --min-value 1 --out x.lorekb", 2, "one rule");
}

TEST_F(LoreKb, values_features_anew_from_the_evidence_of_the_build) {
    expect_done("build run --out kb.lorekb --gammas 0.9 0.5");
    auto const told = nlohmann::json::parse(run("info kb.lorekb --json").output);
    EXPECT_EQ(told.at("evidence").at("returns").at("gammas"), (std::vector<double>{0.5, 0.9}));
    EXPECT_TRUE(told.at("evidence").contains("credit"));
    EXPECT_EQ(told.at("provenance").at("value"), "mean");
    EXPECT_THAT(run("info kb.lorekb").output, HasSubstr("returns for gamma 0.5, 0.9"));

    expect_done("revalue kb.lorekb --value return --gamma 0.9 --out return.lorekb");
    expect_done("build run --out built.lorekb --value return --gamma 0.9 --gammas 0.5");
    KnowledgeBase const revalued = read_knowledge_base(scratch.file("return.lorekb"));
    KnowledgeBase const built = read_knowledge_base(scratch.file("built.lorekb"));
    EXPECT_TRUE(std::equal(revalued.values().begin(), revalued.values().end(), built.values().begin()));
    EXPECT_EQ(built.provenance().value, "return 0.9");
    EXPECT_THAT(revalued.provenance().derivation.back(), HasSubstr("return 0.9"));
    expect_done("verify return.lorekb");
    expect_done("export return.lorekb --npy exported");
    expect_done("verify exported/return_sums.npy");

    expect_done("build run --all --success 1 --out all.lorekb");
    expect_refusal("revalue all.lorekb --value credit --out never", 2, "needs evidence that the base does not have");
    expect_refusal("revalue kb.lorekb --value contrast --out never", 2, "needs evidence that the base does not have");
    expect_refusal("revalue kb.lorekb --value return --gamma 0.7 --out never", 2, "gamma 0.5, 0.9, not 0.7");
    for (char const* gamma : {"0", "1", "-1", "nan", "2"})
        expect_refusal("revalue kb.lorekb --value return --gamma " + std::string{gamma} + " --out never", 2,
                       "discount");
    expect_refusal("revalue kb.lorekb --value median --out never", 2, "mean, return, contrast, credit");
    expect_refusal("revalue kb.lorekb --value mean --gamma 0.9 --out never", 2, "only return discounts");
    expect_refusal("revalue all.lorekb --value contrast --success 2 --out never", 2,
                   "its successes have 1 balls, not 2");
    expect_refusal("revalue all.lorekb --value contrast --success nan --out never", 2, "no finite number");
    expect_refusal("revalue kb.lorekb --value mean --success 1 --out never", 2, "only contrast counts them");
    expect_refusal("build run --value contrast --out never", 2, "a lineage has no contemporaries");
    expect_refusal("build run --all --value contrast --success 1000 --out never", 2,
                   "nobody got 1000 balls, the best ");
    expect_refusal("build run --value return --gamma 1 --out never", 2, "discount");
    expect_refusal("build run --gammas 0.5 1 --out never", 2, "discount");
    expect_refusal("build run --success 2 --out never", 2, "--all");
}

TEST_F(LoreKb, refuses_evidence_that_would_give_no_number) {
    auto const write = [&](std::uint64_t showings, double return_sum) {
        KnowledgeArrays arrays{{0}, std::vector<float>(6), {2.0}, {4.0}, {2}};
        arrays.evidence.gammas = {0.5};
        arrays.evidence.showings = {showings};
        arrays.evidence.return_sums = {return_sum};
        write_knowledge_base(scratch.file("kb.lorekb"),
                             KnowledgeBase{{1, 1.83f, collectball_channels()}, {}, std::move(arrays)});
    };
    std::string const revalue = "revalue kb.lorekb --value return --gamma 0.5 --out never";
    write(0, 0);
    expect_refusal(revalue, 1, "kb.lorekb");
    write(1, std::numeric_limits<double>::quiet_NaN());
    expect_refusal(revalue, 1, "a feature's evidence is not finite");
    write(1, 3);
    expect_done("revalue kb.lorekb --value return --gamma 0.5 --out return.lorekb");
    EXPECT_EQ(read_knowledge_base(scratch.file("return.lorekb")).value(0), 3);
}

TEST_F(LoreKb, looks_up_no_windows_that_are_longer_than_an_evaluation) {
    expect_done("build run --out kb.lorekb -q");
    auto const bytes = read_file(scratch.file("run/config.toml"));
    std::string text{reinterpret_cast<char const*>(bytes.data()), bytes.size()};
    text = std::regex_replace(text, std::regex{"\nsteps = [0-9]+"}, "\nsteps = 10");
    text = std::regex_replace(text, std::regex{"\nwindow_length = [0-9]+"}, "\nwindow_length = 5");
    write_file_atomically(scratch.file("run/config.toml"), std::string_view{text});
    expect_refusal("query kb.lorekb --run run --csv never", 2, "an evaluation has 10");
    expect_refusal("product kb.lorekb --run run --csv never", 2, "an evaluation has 10");
    EXPECT_FALSE(std::filesystem::exists(scratch.file("never")));
}

TEST_F(LoreKb, reads_a_base_of_the_first_layout_but_finds_no_evidence_in_it) {
    std::string const old = LORE_SOURCE_DIR "/tests/data/version-1/sample.lorekb";
    expect_done("revalue " + old + " --value mean --out mean.lorekb");
    for (char const* const rule : {"return", "contrast", "credit"})
        expect_refusal("revalue " + old + " --out never --value " + rule, 2,
                       "needs evidence that the base does not have (it was built without");
}

TEST_F(LoreKb, refuses_in_one_line_what_it_cannot_do) {
    expect_refusal("", 2, "a command is expected");
    expect_refusal("build nowhere --out x.lorekb", 2, "nowhere");
    expect_refusal("build run", 2, "--out");
    expect_refusal("build run --out missing/x.lorekb", 2, "missing");
    expect_refusal("build run --index fast --out x.lorekb", 2, "exact and flann");
    expect_refusal("info run/lineage.lore", 1, "not a knowledge base");
    expect_refusal("verify stderr.txt", 1, "empty");
    std::filesystem::remove(scratch.file("run/all.lore"));
    expect_refusal("build run --all --out x.lorekb", 1, "--archive all");
    EXPECT_FALSE(std::filesystem::exists(scratch.file("x.lorekb")));
}

TEST_F(LoreKb, leaves_the_former_file_where_a_build_fails) {
    expect_done("build run --out kb.lorekb");
    KnowledgeBase const before = read_knowledge_base(scratch.file("kb.lorekb"));
    std::filesystem::resize_file(scratch.file("run/lineage.lore"), 100);
    expect_refusal("build run --out kb.lorekb", 1, "cut");
    EXPECT_EQ(read_knowledge_base(scratch.file("kb.lorekb")).size(), before.size());
}

TEST_F(LoreKb, writes_over_no_file_of_another_kind) {
    expect_done("build run --out kb.lorekb");
    auto const lineage = read_file(scratch.file("run/lineage.lore")), base = read_file(scratch.file("kb.lorekb")),
               progress = read_file(scratch.file("run/progress.csv"));
    expect_refusal("build run --out run/lineage.lore", 2, "it is a lineage archive");
    expect_refusal("clone kb.lorekb --out kb.lorekb", 2, "it is a knowledge base");
    expect_refusal("export kb.lorekb --csv kb.lorekb", 2, "it is a knowledge base");
    expect_refusal("query kb.lorekb --run run --csv run/progress.csv", 2, "it is a file of that run");
    EXPECT_EQ(read_file(scratch.file("run/lineage.lore")), lineage);
    EXPECT_EQ(read_file(scratch.file("kb.lorekb")), base);
    EXPECT_EQ(read_file(scratch.file("run/progress.csv")), progress);
    expect_done("reduce kb.lorekb --top 3 --out kb.lorekb");
    expect_done("query kb.lorekb --run run --csv run/query.csv");
    expect_done("query kb.lorekb --run run --csv run/query.csv");
}

TEST_F(LoreKb, explains_itself) {
    EXPECT_THAT(run("--help").output, HasSubstr("Examples"));
    EXPECT_THAT(run("build --help").output, HasSubstr("--individual"));
    EXPECT_THAT(run("product --help").output, HasSubstr("KB..."));   // one or more
    EXPECT_THAT(run("reduce --help").output, HasSubstr("--consensus TEXT ..."));
    EXPECT_THAT(run("--version").output, StartsWith("lore-kb "));
}
