#include <lore/campaign/plan.h>

#include <lore/campaign/choice.h>
#include <lore/campaign/steps.h>
#include <lore/campaign/worlds.h>
#include <lore/core/error.h>

#include "campaign_fixture.h"
#include "support/c_worlds.h"
#include "support/complaint.h"

#include <campaign/treatment_inputs.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace lore;

namespace {

std::string const two_worlds = R"(
title = "Two worlds"
runs = 2
generations = 20
[[source]]
name = "arena"
label = "arena with a door"
config = "source.toml"
runs = 3
first_seed = 100
[[source]]
name = "pole"
config = "pole.toml"
[[target]]
name = "arena"
label = "the arena"
config = "target.toml"
first_seed = 7
[[target]]
name = "pole"
label = "the pole"
config = "pole.toml"
generations = 5
set = ["evolution.ties=older"]
[transfer]
method = "clone"
top = 10
)";

class Transfer : public test::CampaignTest {
protected:
    Transfer() {
        write("pole.toml", "name = \"pole\"\n[world]\nlibrary = \"" + test::c_world("pendulum") + "\"\n");
        write("campaign.toml", two_worlds);
    }
    std::string complaint(std::string const& from, std::string const& to) {
        std::string text = two_worlds;
        text.replace(text.find(from), from.size(), to);
        write("campaign.toml", text);
        return test::complaint_of<UsageError>([&] { plan(); });
    }
    static std::vector<std::string> names(std::vector<Treatment> const& treatments) {
        std::vector<std::string> all;
        for (Treatment const& treatment : treatments) all.push_back(treatment.name);
        return all;
    }
};

}   // namespace

TEST_F(Transfer, makes_treatments_for_each_target_of_the_sources_that_fit) {
    CampaignPlan const campaign = plan();
    EXPECT_EQ(names(campaign.sources), (std::vector<std::string>{"arena", "pole"}));
    EXPECT_EQ(names(campaign.targets),
              (std::vector<std::string>{"arena_from_none", "arena_from_arena", "pole_from_none", "pole_from_pole"}));
    Treatment const& none = campaign.treatment("arena_from_none");
    EXPECT_EQ(none.label, "the arena: no knowledge");
    EXPECT_EQ(none.first_seed, 7u);
    EXPECT_EQ(none.runs, 2);
    EXPECT_TRUE(none.clone_of.empty());
    Treatment const& helped = campaign.treatment("pole_from_pole");
    EXPECT_EQ(helped.clone_of, std::vector<std::string>{"pole_best"});
    EXPECT_EQ(helped.target, "pole");
    EXPECT_EQ(helped.overrides, (std::vector<std::string>{"evolution.generations=5", "evolution.ties=older"}));
    EXPECT_EQ(campaign.treatment("arena_from_arena").label, "the arena: from arena with a door");
    EXPECT_EQ(campaign.knowledge_base("pole_best").base, "pole");
    EXPECT_TRUE(campaign.knowledge_base("arena").best_run);

    ASSERT_EQ(campaign.transfer.size(), 4u) << "row by row";
    EXPECT_EQ(campaign.transfer[0].treatment, "arena_from_arena");
    EXPECT_EQ(campaign.transfer[1].treatment, "");
    EXPECT_EQ(campaign.transfer[1].none, "pole_from_none");
    EXPECT_NE(campaign.transfer[1].misfit.find("sensors"), std::string::npos);
    EXPECT_EQ(campaign.transfer[3].misfit, "");
    auto const groups = task_groups(campaign);
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[1].task, "pole");
    EXPECT_EQ(groups[1].treatments, (std::vector<std::string>{"pole_from_none", "pole_from_pole"}));
}

TEST_F(Transfer, has_steps_and_files_by_source) {
    CampaignPlan const campaign = plan();
    CampaignDirectory const directory{"c"};
    auto const step = [&](std::string const& name) { return steps_named(steps_of(campaign), {name}).front(); };
    auto const command = [&](std::string const& name, Choice const* choice = nullptr) {
        return shell_text(command_of(campaign, directory, Launcher{}, step(name), choice));
    };
    // 3 and 2 source runs, a choice each, 4 bases, 4 treatments of 2.
    EXPECT_EQ(steps_of(campaign).size(), 5u + 2 + 4 + 8);
    EXPECT_EQ(step("choose/pole").after, std::vector<std::string>{"pole"});
    EXPECT_EQ(step("knowledge/pole").after, std::vector<std::string>{"choose/pole"});
    EXPECT_EQ(step("pole_from_pole/001").after, std::vector<std::string>{"knowledge/pole_best"});
    EXPECT_EQ(directory.choice("pole"), "c/knowledge/choice-pole.json");
    EXPECT_EQ(directory.choice(), "c/knowledge/choice.json");
    EXPECT_EQ(command("knowledge/pole"), "lore-kb build 'c/runs/pole/?' --out c/knowledge/pole.lorekb");
    Choice some;
    some.chosen = {{"arena", 0, 2, 101, 6}};
    EXPECT_EQ(command("knowledge/arena", &some), "lore-kb build c/runs/arena/002 --out c/knowledge/arena.lorekb");
    EXPECT_EQ(command("knowledge/pole", &some), command("knowledge/pole")) << "that source has no choice yet";
}

TEST_F(Transfer, runs_like_any_campaign_and_takes_the_best_run_of_each_source) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    for (auto const& [step, state] : states_of(plan(), directory()))
        EXPECT_EQ(state.status, StepStatus::done) << step.name;
    Choice const choice = read_choice(directory().choice("arena"));
    EXPECT_EQ(choice.considered.size(), 3u);
    for (SourceRun const& run : choice.considered) EXPECT_LE(run.reward, choice.of("arena").reward);
    EXPECT_TRUE(choice.of("arena").best);
    EXPECT_FALSE(std::filesystem::exists(directory().choice()));
}

TEST_F(Transfer, can_name_the_source_run_and_other_uses) {
    ASSERT_EQ(complaint("top = 10", "run = 2"), "");
    EXPECT_EQ(plan().knowledge_base("pole").run, 2);
    EXPECT_EQ(plan().treatment("pole_from_pole").clone_of, std::vector<std::string>{"pole"});
    ASSERT_EQ(complaint("method = \"clone\"\ntop = 10", "method = \"policy\""), "");
    EXPECT_EQ(plan().treatment("pole_from_pole").policy_of, std::vector<std::string>{"pole"});
    ASSERT_EQ(complaint("method = \"clone\"", "method = \"shaping\""), "");
    EXPECT_EQ(plan().treatment("pole_from_pole").knowledge, std::vector<std::string>{"pole_best"});
}

TEST_F(Transfer, stands_beside_treatments_written_by_hand) {
    write("campaign.toml", two_worlds + "[[knowledge]]\nname = \"second\"\nsource = \"arena\"\nrun = 1\n"
                                        "[[treatment]]\nname = \"policy\"\ntarget = \"arena\"\npolicy_of = \"arena\"\n"
                                        "runs = 1\ngenerations = 9\n");
    Treatment const treatment = plan().treatment("policy");
    EXPECT_EQ(treatment.config, "target.toml");
    EXPECT_EQ(treatment.runs, 1);
    EXPECT_EQ(treatment.first_seed, 7u) << "as its target task says";
    EXPECT_EQ(treatment.overrides.back(), "evolution.generations=9");
    EXPECT_EQ(plan().knowledge_base("second").source, "arena");
    Step const first = steps_named(steps_of(plan()), {"policy"}).front();
    EXPECT_EQ(first.after, std::vector<std::string>{"choose/arena"});
}

TEST_F(Transfer, of_one_source_has_the_names_of_a_campaign_with_one) {
    std::string text = two_worlds;
    std::size_t const from = text.find("[[source]]"), to = text.find("[[target]]");
    write("campaign.toml", text.replace(from, to - from, "[source]\nconfig = \"source.toml\"\nruns = 3\n"));
    CampaignPlan const campaign = plan();
    EXPECT_EQ(campaign.transfer.size(), 2u);
    EXPECT_EQ(campaign.targets.at(1).name, "arena_from_source");
    EXPECT_NO_THROW(steps_named(steps_of(campaign), {"source/003", "choose", "knowledge/source_best"}));
}

TEST_F(Transfer, takes_every_pair_for_fitting_where_a_world_is_not_at_hand_and_refuses_to_run) {
    write("pole.toml", "name = \"pole\"\n[world]\nlibrary = \"nowhere\"\n");
    CampaignPlan const campaign = plan();
    EXPECT_EQ(campaign.targets.size(), 6u);
    std::string const told = test::complaint_of<UsageError>([&] { check_worlds(campaign); });
    EXPECT_NE(told.find("cannot open the world of treatment 'pole'"), std::string::npos) << told;
}

TEST_F(Transfer, refuses_mistakes_in_one_line_that_helps) {
    auto const expect = [&](std::string const& from, std::string const& to, std::string const& says) {
        std::string const said = complaint(from, to);
        EXPECT_NE(said.find(says), std::string::npos) << "for " << to << ": " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    };
    std::string const transfer = "[transfer]\nmethod = \"clone\"\ntop = 10\n";
    auto const hand = [](std::string const& keys) { return "[[treatment]]\nname = \"hand\"\n" + keys + "\n"; };
    auto const base = [](std::string const& keys) { return "[[knowledge]]\nname = \"kb\"\n" + keys + "\n"; };
    expect("name = \"pole\"\nconfig", "name = \"arena\"\nconfig", "'arena' is defined twice");
    expect("name = \"pole\"\nlabel", "name = \"arena\"\nlabel", "'arena' is defined twice");
    expect("name = \"pole\"\nconfig", "name = \"choose\"\nconfig", "reserved");
    expect("name = \"pole\"\nconfig", "name = \"none\"\nconfig", "stands for no knowledge");
    expect("method = \"clone\"", "method = \"cloning\"", "Choose one of shaping, clone, policy");
    expect("method = \"clone\"\n", "", "method");
    expect("method = \"clone\"", "method = \"policy\"", "not features");
    expect("top = 10", "topp = 10", "Did you mean 'transfer.top'");
    expect("top = 10", "run = 3", "the last pole run is 2");
    expect("set = [\"evolution.ties=older\"]\n", "", "target task 'pole' would be runs of source 'pole' again");
    expect(transfer, "", "no treatment has the target task 'arena'");
    expect(transfer, transfer + hand("target = \"pol\""), "Did you mean 'pole'");
    expect(transfer, transfer + hand("target = \"pole\"\nconfig = \"pole.toml\""), "it excludes 'target'");
    expect(transfer, transfer + hand("target = \"pole\"\npolicy_of = \"poles\""), "Did you mean 'pole'");
    expect(transfer, transfer + base("run = 1"), "which of the 2 source tasks");
    expect(transfer, transfer + base("run = 1\nsource = \"poles\""), "Did you mean 'pole'");
    expect(transfer, transfer + base("best_of = \"poles\""), "Did you mean 'pole'");
    expect(transfer, transfer + "[[treatment]]\nname = \"pole_from_none\"\ntarget = \"pole\"\n", "defined twice");
    expect(transfer, transfer + "[[knowledge]]\nname = \"pole\"\nrun = 1\nsource = \"pole\"\n", "defined twice");
    expect("generations = 5", "clone_of = \"pole\"", "the target task takes nothing from other steps");
    expect("config = \"pole.toml\"\n[[target]]", "config = \"pol.toml\"\n[[target]]", "pol.toml");
    std::string without = two_worlds;
    without = without.substr(0, without.find("[[target]]")) + transfer;
    write("campaign.toml", without);
    EXPECT_NE(test::complaint_of<UsageError>([&] { plan(); }).find("there is no target task"), std::string::npos);
    expect(
        two_worlds.substr(two_worlds.find("[[source]]"), two_worlds.find("[[target]]") - two_worlds.find("[[source]]")),
        "source = []\n", "Add a table [[source]]");
}

TEST_F(Transfer, has_every_method_in_its_documentation) {
    std::string const page = read(LORE_SOURCE_DIR "/docs/manual/campaigns.md");
    for (TreatmentInput const& input : treatment_inputs())
        EXPECT_NE(page.find("`" + std::string{input.method} + "`"), std::string::npos) << input.method;
}
