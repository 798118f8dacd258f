#include <lore/campaign/plan.h>

#include <lore/campaign/choice.h>
#include <lore/campaign/steps.h>
#include <lore/campaign/worlds.h>
#include <lore/core/error.h>

#include "campaign_fixture.h"
#include "support/c_worlds.h"
#include "support/complaint.h"

#include <campaign/knowledge_kinds.h>
#include <campaign/treatment_inputs.h>

#include <gmock/gmock.h>

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

using namespace lore;
using ::testing::HasSubstr;

class Campaign : public test::CampaignTest {
protected:
    /// What read_campaign says of the small campaign with one piece of text exchanged.
    std::string complaint(std::string const& from, std::string const& to) {
        std::string text = test::small_campaign;
        text.replace(text.find(from), from.size(), to);
        write("campaign.toml", text);
        return test::complaint_of<UsageError>([&] { plan(); });
    }
};

TEST_F(Campaign, gives_treatments_the_common_values_and_their_own) {
    CampaignPlan const campaign = plan();
    EXPECT_EQ(campaign.sources.front().runs, 4);
    EXPECT_EQ(campaign.targets.at(0).runs, 3);
    EXPECT_EQ(campaign.targets.at(1).overrides, std::vector<std::string>{"evolution.generations=20"});
    EXPECT_EQ(campaign.report_order, (std::vector<std::string>{"none", "all", "kb1"}));
    EXPECT_EQ(seed_of(campaign.sources.front(), 1), 1u);
    EXPECT_EQ(seed_of(campaign.sources.front(), 4), 4u);
}

TEST_F(Campaign, is_found_where_it_has_moved) {
    CampaignPlan const campaign = read_campaign(LORE_SOURCE_DIR "/jobs/small.toml");
    EXPECT_EQ(campaign.path, LORE_SOURCE_DIR "/jobs/campaigns/small.toml");
    EXPECT_EQ(campaign.config_path(campaign.sources.front()), LORE_SOURCE_DIR "/jobs/tasks/source.toml");
}

TEST_F(Campaign, reads_the_files_that_come_with_lore) {
    CampaignPlan const paper = read_campaign(LORE_SOURCE_DIR "/jobs/campaigns/paper.toml");
    EXPECT_EQ(paper.sources.front().runs, 30);
    EXPECT_EQ(paper.knowledge.size(), 6u);
    EXPECT_EQ(paper.targets.size(), 7u);
    EXPECT_EQ(paper.report_order.front(), "none");
    // 30 source runs, the choice, 6 knowledge bases, one archive, 7 treatments of 30, the replay.
    EXPECT_EQ(steps_of(paper).size(), 30u + 1 + 6 + 1 + 210 + 1);
    CampaignPlan const small = read_campaign(LORE_SOURCE_DIR "/jobs/campaigns/small.toml");
    EXPECT_EQ(small.report_order, paper.report_order);
    CampaignPlan const still = read_campaign(LORE_SOURCE_DIR "/jobs/campaigns/still.toml");
    EXPECT_EQ(still.targets.at(2).knowledge, std::vector<std::string>{"kb1_permuted"});
    EXPECT_EQ(steps_of(still).size(), 30u + 1 + 6 + 210 + 1);
    CampaignPlan const screening = read_campaign(LORE_SOURCE_DIR "/jobs/campaigns/screening.toml");
    EXPECT_EQ(screening.knowledge_base("base_return").value, (ValueConfig{ValueRule::discounted_return, 0.995}));
    EXPECT_EQ(screening.knowledge_base("base").gammas, std::vector<double>{}) << "lore-kb gathers 0.995 anyway";
    EXPECT_EQ(screening.treatment("clone_credit").clone_of, std::vector<std::string>{"base_credit"});
    CampaignPlan const ties = read_campaign(LORE_SOURCE_DIR "/jobs/campaigns/ties.toml");
    EXPECT_EQ(steps_of(ties).size(), 30u + 1 + 2 + 90 + 1);
    // These work in the directory of the paper's campaign: what they share has the same name and the same meaning.
    CampaignDirectory const directory{"paper"};
    struct Sharing {
        char const* name;
        int steps;
    };
    for (auto const& [name, steps] :
         {Sharing{"beyond", 30 + 1 + 3 + 60}, Sharing{"saturation", 30 + 1 + 5}, Sharing{"windows", 30 + 1 + 1},
          Sharing{"faster", 30 + 1 + 3}, Sharing{"longer", 30 + 1 + 1}}) {
        CampaignPlan const sharing = read_campaign(std::string{LORE_SOURCE_DIR "/jobs/campaigns/"} + name + ".toml");
        int shared = 0;
        for (Step const& step : steps_of(sharing))
            for (Step const& same : steps_of(paper))
                if (step.name == same.name && step.kind != StepKind::replay) {   // which has the file's name
                    ++shared;
                    EXPECT_EQ(command_of(sharing, directory, {}, step, nullptr),
                              command_of(paper, directory, {}, same, nullptr));
                }
        EXPECT_EQ(shared, steps) << name;
    }
}

TEST_F(Campaign, has_each_step_that_is_named_once_in_its_order) {
    std::vector<std::string> names;
    for (Step const& step : steps_named(steps_of(plan()), {"none/002", "source/003", "source", "none/002"}))
        names.push_back(step.name);
    EXPECT_EQ(names, (std::vector<std::string>{"source/001", "source/002", "source/003", "source/004", "none/002"}));
}

TEST_F(Campaign, refuses_mistakes_in_one_line_that_helps) {
    EXPECT_NE(complaint("top = 10", "topp = 10").find("Did you mean 'knowledge[4].top'"), std::string::npos);
    EXPECT_NE(complaint("top = 10", "").find("one of top, least_value, least_count, consensus is missing"),
              std::string::npos);
    EXPECT_NE(complaint("all_of = \"kb1\"", "all_of = \"kb11\"").find("Did you mean 'kb1'"), std::string::npos);
    EXPECT_NE(complaint("all_of = \"kb1\"", "lineage_of = \"kb1_all\"").find("no 'kb1_all' before"), std::string::npos);
    EXPECT_NE(complaint("part_of = \"kb1\"\ntop = 10", "lineage_of = \"kb1_random\"")
                  .find("with 'balls', 'reward', 'run' or 'best_of'"),
              std::string::npos);
    EXPECT_NE(complaint("top = 10", "consensus = []").find("it names no base"), std::string::npos);
    EXPECT_NE(complaint("[report]", "[report]\nfigure5 = [\"kb1\", \"kb1\"]").find("it names 'kb1' twice"),
              std::string::npos);
    EXPECT_NE(complaint("name = \"none\"", "name = \"choose\"").find("reserved"), std::string::npos);
    EXPECT_NE(complaint("name = \"kb2\"", "name = \"kb1\"").find("twice"), std::string::npos);
    EXPECT_NE(complaint("name = \"none\"", "name = \"../none\"").find("letters"), std::string::npos);
    EXPECT_NE(complaint("runs = 4", "runs = 1").find("need as many source runs"), std::string::npos);
    EXPECT_NE(complaint("balls = 2", "balls = 2\nrun = 3").find("excludes"), std::string::npos);
    EXPECT_NE(complaint("runs = 4", "knowledge = \"kb1\"").find("takes nothing from other steps"), std::string::npos);
    EXPECT_NE(complaint("random_of = \"kb1\"", "permuted_of = \"kb3\"").find("no 'kb3' before"), std::string::npos);
    EXPECT_NE(complaint("order = [\"none\", ", "order = [").find("every treatment once"), std::string::npos);
    EXPECT_NE(complaint("config = \"target.toml\"", "config = \"target.tml\"").find("target.tml"), std::string::npos);
    EXPECT_NE(complaint("generations = 20", "generatons = 20").find("Did you mean 'generations'"), std::string::npos);
    std::string const misspelt = complaint("runs = 4", "set = [\"evolution.popultion=3\"]");
    EXPECT_NE(misspelt.find("campaign.toml, line 7: source.set ("), std::string::npos) << misspelt;
    EXPECT_NE(misspelt.find("population"), std::string::npos) << misspelt;
}

TEST_F(Campaign, takes_treatments_together_in_pools) {
    std::string const pool = "[[pool]]\nname = \"with\"\ntreatments = [\"all\", \"kb1\"]\nagainst = [\"none\"]\n";
    std::string const second =
        "[[pool]]\nname = \"one\"\nlabel = \"One\"\ntreatments = [\"none\"]\nagainst = [\"with\"]\n";
    write("campaign.toml", test::small_campaign + pool + second);
    CampaignPlan const campaign = plan();
    ASSERT_EQ(campaign.pools.size(), 2u);
    EXPECT_EQ(campaign.pool("with")->treatments, (std::vector<std::string>{"all", "kb1"}));
    EXPECT_EQ(campaign.label("with"), "with");
    EXPECT_EQ(campaign.label("one"), "One");
    EXPECT_EQ(campaign.label("none"), "no transfer");
    EXPECT_EQ(campaign.pool("none"), nullptr);

    auto const refused = [&](std::string const& tables) {
        write("campaign.toml", test::small_campaign + tables);
        return test::complaint_of<UsageError>([&] { plan(); });
    };
    auto const table = [](std::string const& name, std::string const& keys) {
        return "[[pool]]\nname = \"" + name + "\"\n" + keys + "\n";
    };
    EXPECT_NE(refused(table("kb1", "treatments = [\"all\"]")).find("twice"), std::string::npos);
    EXPECT_NE(refused(table("with", "treatments = [\"kb\"]")).find("Did you mean 'kb1'"), std::string::npos);
    EXPECT_NE(refused(table("with", "treatments = []")).find("one treatment or more"), std::string::npos);
    EXPECT_NE(refused(table("with", "treatments = [\"all\", \"all\"]")).find("each once"), std::string::npos);
    EXPECT_NE(refused(table("with", "treatments = [\"source\"]")).find("no 'source' before"), std::string::npos);
    EXPECT_NE(refused(table("with", "treatments = [\"all\"]\nagainst = [\"all\"]")).find("with itself"),
              std::string::npos);
    EXPECT_NE(refused(table("with", "treatments = [\"all\"]\nagainst = [\"none\", \"none\"]")).find("one twice"),
              std::string::npos);
    EXPECT_NE(refused(pool + table("again", "treatments = [\"kb1\"]\nagainst = [\"with\"]")).find("'kb1' would be"),
              std::string::npos);
    EXPECT_NE(refused(table("with", "treatments = [\"all\"]\nversus = [\"none\"]")).find("versus"), std::string::npos);
}

TEST_F(Campaign, has_runs_read_the_windows_of_their_base) {
    using Settings = std::vector<std::string>;
    Settings const generations{"evolution.generations=20"},
        fitted{"knowledge.window_length=10", "knowledge.match_threshold=1.294", "evolution.generations=20"};
    auto const settings = [&](std::string_view treatment) { return plan().treatment(treatment).overrides; };
    auto const complaint_with = [&](std::string const& keys, std::string const& knowledge, std::string const& set) {
        return complaint("knowledge = \"kb1\"\n[[treatment]]",
                         "knowledge = \"" + knowledge + "\"\n" + set +
                             "[[knowledge]]\nname = \"short\"\nlineage_of = \"kb1\"\n" + keys + "[[treatment]]");
    };
    std::string const own = "window_length = 10\nmatch_threshold = 1.294\n";
    EXPECT_EQ(complaint_with(own, "short", ""), "");
    EXPECT_EQ(settings("kb1"), fitted);
    EXPECT_EQ(settings("none"), generations);
    EXPECT_EQ(settings("all"), generations) << "its base has the usual windows";
    EXPECT_EQ(complaint_with(own + "[[knowledge]]\nname = \"drawn\"\nrandom_of = \"short\"\n", "drawn", ""), "");
    EXPECT_EQ(settings("kb1"), fitted) << "drawn values change no windows";
    EXPECT_EQ(complaint("runs = 4", "runs = 4\nset = [\"knowledge.match_threshold=1.5\"]"), "");
    EXPECT_EQ(settings("kb1").at(1), "knowledge.match_threshold=1.5") << "bases are built as their source run says";

    std::string const other = complaint_with(own, "short", "set = [\"knowledge.window_length=5\"]\n");
    EXPECT_NE(other.find("windows of 5 steps and threshold 1.294, and 'short' has 10 and 1.294"), std::string::npos)
        << other;
    EXPECT_NE(complaint_with("options = [\"--threshold\", \"1.5\"]\n", "short", "").find("Write window_length"),
              std::string::npos);
    EXPECT_NE(complaint_with("match_threshold = 0\n", "short", "").find("0 matches nothing"), std::string::npos);
}

TEST_F(Campaign, orders_steps_after_those_that_they_wait_for) {
    std::vector<Step> const steps = steps_of(plan());
    for (auto step = steps.begin(); step != steps.end(); ++step)
        for (std::string const& group : step->after)
            EXPECT_TRUE(std::none_of(step, steps.end(), [&](Step const& later) { return later.group == group; }))
                << step->name;
}

TEST_F(Campaign, writes_commands_that_a_shell_takes) {
    CampaignPlan const campaign = plan();
    Choice choice;
    choice.chosen = {{"kb1", 6, 3, 3, 6}, {"kb2", 2, 1, 1, 2}};
    auto command = [&](std::string const& step) {
        return shell_text(command_of(campaign, CampaignDirectory{"c"}, Launcher{},
                                     steps_named(steps_of(campaign), {step}).front(), &choice));
    };
    std::string const here = campaign.directory;
    EXPECT_EQ(command("kb1/002"), "lore-evolve " + here +
                                      "/target.toml --seed 2 --out c/runs/kb1/002 --resume --set "
                                      "evolution.generations=20 --kb c/knowledge/kb1.lorekb");
    EXPECT_EQ(
        command("archive/kb1_all"),
        "lore-evolve " + here +
            "/source.toml --seed 3 --out c/runs/archive/kb1_all --resume --set evolution.generations=20 --archive all");
    EXPECT_EQ(command("knowledge/kb1"), "lore-kb build c/runs/source/003 --out c/knowledge/kb1.lorekb");
    EXPECT_EQ(command("knowledge/kb1_all"),
              "lore-kb build c/runs/archive/kb1_all --all --out c/knowledge/kb1_all.lorekb");
    EXPECT_EQ(command("knowledge/kb1_top"),
              "lore-kb reduce c/knowledge/kb1.lorekb --top 10 --out c/knowledge/kb1_top.lorekb");
    write("permuted.toml", std::string{test::small_campaign}.insert(
                               test::small_campaign.find("[[treatment]]"),
                               "[[knowledge]]\nname = \"permuted\"\npermuted_of = \"kb1\"\nseed = 7\n"));
    CampaignPlan const permuted = read_campaign(scratch.file("permuted.toml"));
    Step const permuting = steps_named(steps_of(permuted), {"knowledge/permuted"}).front();
    EXPECT_EQ(permuting.after, std::vector<std::string>{"knowledge/kb1"});
    EXPECT_EQ(shell_text(command_of(permuted, CampaignDirectory{"c"}, Launcher{}, permuting, &choice)),
              "lore-kb randomize c/knowledge/kb1.lorekb --permute --seed 7 --out c/knowledge/permuted.lorekb");
    write("narrow.toml",
          std::string{test::small_campaign}.insert(
              test::small_campaign.find("[[treatment]]"),
              "[[knowledge]]\nname = \"narrow\"\nlineage_of = \"kb1\"\nmatch_threshold = 1.5\nwindow_length = 10\n"));
    CampaignPlan const narrow = read_campaign(scratch.file("narrow.toml"));
    EXPECT_EQ(shell_text(command_of(narrow, CampaignDirectory{"c"}, Launcher{},
                                    steps_named(steps_of(narrow), {"knowledge/narrow"}).front(), &choice)),
              "lore-kb build c/runs/source/003 --window-length 10 --threshold 1.5 --out c/knowledge/narrow.lorekb");
    write("shown.toml",
          std::string{test::small_campaign}.replace(test::small_campaign.find("top = 10"), 8, "least_count = 5"));
    CampaignPlan const shown = read_campaign(scratch.file("shown.toml"));
    EXPECT_EQ(shell_text(command_of(shown, CampaignDirectory{"c"}, Launcher{},
                                    steps_named(steps_of(shown), {"knowledge/kb1_top"}).front(), &choice)),
              "lore-kb reduce c/knowledge/kb1.lorekb --min-count 5 --out c/knowledge/kb1_top.lorekb");
    EXPECT_EQ(shell_text({"a b", "it's", ""}), "'a b' 'it'\\''s' ''");

    Launcher four;
    four.ranks = 4;
    auto const words = command_of(campaign, CampaignDirectory{"c"}, four, steps_of(campaign).front(), nullptr);
    std::string const start = shell_text({words.begin(), words.begin() + 6});
    EXPECT_TRUE(start.starts_with("mpirun") && start.ends_with(" -n 4 --bind-to none lore-evolve")) << start;
    four.launch = "srun --ntasks={ranks} --label";
    auto const srun = command_of(campaign, CampaignDirectory{"c"}, four, steps_of(campaign).front(), nullptr);
    EXPECT_EQ(shell_text({srun.begin(), srun.begin() + 4}), "srun --ntasks=4 --label lore-evolve");
}

namespace {

std::string revalued(std::string const& name, std::string const& of, std::string const& value) {
    return "[[knowledge]]\nname = \"" + name + "\"\nrevalued_of = \"" + of + "\"\nvalue = " + value + "\n";
}

}   // namespace

TEST_F(Campaign, makes_a_base_of_each_source_run_and_others_from_each_of_these) {
    std::string const treatment = "[[treatment]]\nname = \"none\"\n";
    std::string const families = "[[knowledge]]\nname = \"base\"\nlabel = \"run\"\nrun = \"each\"\n"
                                 "[[knowledge]]\nname = \"drawn\"\npermuted_of = \"base\"\nseed = 5\n"
                                 "[[knowledge]]\nname = \"best\"\npart_of = \"drawn\"\ntop = 10\n";
    std::string const text = "title = \"t\"\n[source]\nconfig = \"source.toml\"\nruns = 3\n" + families + treatment +
                             "config = \"target.toml\"\nclone_of = \"best\"\n";
    write("campaign.toml", text);
    CampaignPlan const campaign = plan();
    EXPECT_EQ(campaign.treatment("none").clone_of, (std::vector<std::string>{"best1", "best2", "best3"}));
    EXPECT_EQ(campaign.members({"base", "best2"}), (std::vector<std::string>{"base1", "base2", "base3", "best2"}));
    KnowledgePlan const& second = campaign.knowledge_base("base2");
    EXPECT_EQ(second.run, 2);
    EXPECT_EQ(second.label, "run 2");
    EXPECT_EQ(campaign.knowledge_base("drawn3").base, "base3");
    EXPECT_EQ(campaign.knowledge_base("drawn3").seed, 7u);
    EXPECT_EQ(campaign.knowledge_base("best1").base, "drawn1");

    auto const refused = [&](std::string const& old, std::string const& now) {
        std::string changed = text;
        changed.replace(changed.find(old), old.size(), now);
        write("campaign.toml", changed);
        return test::complaint_of<UsageError>([&] { plan(); });
    };
    EXPECT_THAT(refused("run = \"each\"", "run = \"all\""), HasSubstr("a number or \"each\" is expected"));
    EXPECT_THAT(refused("runs = 3", "runs = 0"), HasSubstr("its source has no runs"));
    EXPECT_THAT(refused("clone_of = \"best\"", "clone_of = []"), HasSubstr("the list is empty"));
    EXPECT_THAT(refused("clone_of = \"best", "clone_of = \"besd"), HasSubstr("Did you mean 'best'?"));
    EXPECT_THAT(refused("clone_of", "policy_of"), HasSubstr("'best1' is made from another base"));
    EXPECT_EQ(refused("top = 10", "consensus = [\"base\"]"), "");
    EXPECT_EQ(plan().knowledge_base("best1").consensus.size(), 3u);
    EXPECT_THAT(refused("top = 10\n", "top = 10\n[[knowledge]]\nname = \"more\"\nrun = 1\n"),
                HasSubstr("make other bases from its members with lineage_of"));
    EXPECT_THAT(refused("name = \"drawn\"", "name = \"base\""), HasSubstr("'base' is defined twice"));
    EXPECT_THAT(refused("name = \"drawn\"", "name = \"base2\""), HasSubstr("'base2' is defined twice"));
    EXPECT_THAT(refused("clone_of", "knowledge"), HasSubstr("one base shapes the reward"));
}

TEST_F(Campaign, takes_founders_from_several_bases_or_source_runs) {
    std::string const treatment = "[[treatment]]\nname = \"none\"\n";
    auto const founders_of = [&](std::string const& key) {
        EXPECT_EQ(complaint(treatment, treatment + key + "\n"), "");
        auto const steps = steps_named(steps_of(plan()), {"none"});
        std::string const command =
            shell_text(command_of(plan(), CampaignDirectory{"c"}, Launcher{}, steps.front(), nullptr));
        return command.substr(command.find("--founders")) + " after " +
               fmt::format("{}", fmt::join(steps.front().after, ", "));
    };
    EXPECT_EQ(founders_of("clone_of = [\"kb1\", \"kb2\"]"),
              "--founders c/knowledge/kb1.lorekb c/knowledge/kb2.lorekb after knowledge/kb1, knowledge/kb2");
    EXPECT_EQ(founders_of("policy_of = [\"kb2\", \"kb1\"]"),
              "--founders 'c/runs/source/?' 'c/runs/source/?' after choose");
    EXPECT_NE(complaint(treatment, treatment + "clone_of = [\"kb1\", \"kb1\"]\n").find("it names 'kb1' twice"),
              std::string::npos);
    EXPECT_NE(complaint(treatment, treatment + "knowledge = [\"kb1\", \"kb2\"]\n").find("one base shapes the reward"),
              std::string::npos);
    EXPECT_NE(complaint(treatment, treatment + "clone_of = [\"kb1\", \"kb9\"]\n").find("there is no 'kb9'"),
              std::string::npos);
}

TEST_F(Campaign, has_bases_gather_what_those_revalued_from_them_need) {
    std::string const treatment = "[[treatment]]\nname = \"none\"\n";
    std::string const bases = revalued("credit", "kb1", "\"credit\"") + revalued("usual", "kb1", "\"return\"") +
                              revalued("short", "kb1_random", "\"return\"\ngamma = 0.9") +
                              revalued("shorter", "short", "\"return\"\ngamma = 0.5") +
                              revalued("again", "kb1", "\"return\"\ngamma = 0.9") +
                              revalued("second", "kb2", "\"return\"\ngamma = 0.99") +
                              revalued("contrast", "kb1_all", "\"contrast\"\nsuccess = 4") +
                              "[[knowledge]]\nname = \"drawn\"\npermuted_of = \"short\"\n";
    ASSERT_EQ(complaint(treatment, bases + treatment + "clone_of = \"drawn\"\n"), "");
    CampaignPlan const campaign = plan();
    auto const step = [&](std::string const& name) { return steps_named(steps_of(campaign), {name}).front(); };
    auto const command = [&](std::string const& name) {
        return shell_text(command_of(campaign, CampaignDirectory{"c"}, Launcher{}, step(name), nullptr));
    };
    EXPECT_EQ(command("knowledge/kb1"),
              "lore-kb build 'c/runs/source/?' --gammas 0.5 0.9 0.99 0.995 0.998 --out c/knowledge/kb1.lorekb");
    EXPECT_EQ(command("knowledge/kb2"), "lore-kb build 'c/runs/source/?' --out c/knowledge/kb2.lorekb")
        << "lore-kb gathers returns for 0.99 anyway";
    EXPECT_EQ(command("knowledge/kb1_all"),
              "lore-kb build c/runs/archive/kb1_all --all --success 4 --out c/knowledge/kb1_all.lorekb");
    EXPECT_EQ(command("knowledge/credit"),
              "lore-kb revalue c/knowledge/kb1.lorekb --value credit --out c/knowledge/credit.lorekb");
    EXPECT_EQ(
        command("knowledge/short"),
        "lore-kb revalue c/knowledge/kb1_random.lorekb --value return --gamma 0.9 --out c/knowledge/short.lorekb");
    EXPECT_EQ(command("knowledge/contrast"), "lore-kb revalue c/knowledge/kb1_all.lorekb --value contrast --success 4 "
                                             "--out c/knowledge/contrast.lorekb");
    EXPECT_EQ(step("knowledge/shorter").after, std::vector<std::string>{"knowledge/short"});
    EXPECT_EQ(step("none/001").after, std::vector<std::string>{"knowledge/drawn"});

    ASSERT_EQ(complaint("balls = 6",
                        "balls = 6\noptions = [\"--gammas\", \"0.7\"]\n" + revalued("usual", "kb1", "\"return\"")),
              "");
    EXPECT_EQ(shell_text(command_of(plan(), CampaignDirectory{"c"}, Launcher{}, step("knowledge/kb1"), nullptr)),
              "lore-kb build 'c/runs/source/?' --gammas 0.995 --gammas 0.7 --out c/knowledge/kb1.lorekb");
}

TEST_F(Campaign, refuses_values_that_no_evidence_will_give) {
    std::string const treatment = "[[treatment]]\nname = \"none\"\n";
    auto const complaint_of = [&](std::string const& bases) { return complaint(treatment, bases + treatment); };
    auto const expect = [&](std::string const& of, std::string const& value, std::string const& says) {
        std::string const said = complaint_of(revalued("new", of, value));
        EXPECT_NE(said.find(says), std::string::npos) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    };
    expect("kb1", "\"median\"", "there are mean, return, contrast, credit");
    for (char const* gamma : {"0", "1", "-0.5", "1.5"})
        expect("kb1", std::string{"\"return\"\ngamma = "} + gamma, "is no discount");
    expect("kb1", "\"return\"\ngamma = nan", "gamma");
    expect("kb1", "\"mean\"\ngamma = 0.9", "only return discounts");
    expect("kb1", "\"credit\"\nsuccess = 2", "only contrast counts them");
    expect("kb1_all", "\"contrast\"\nsuccess = nan", "success");
    expect("kb1", "\"contrast\"", "a lineage has no contemporaries");
    expect("kb1_random", "\"contrast\"", "a lineage has no contemporaries");
    expect("kb1_all", "\"credit\"", "it takes pairs of parent and child");
    expect("kb3", "\"mean\"", "there is no 'kb3' before it");
    std::string const two = complaint_of(revalued("a", "kb1_all", "\"contrast\"\nsuccess = 2") +
                                         revalued("b", "kb1_all", "\"contrast\"\nsuccess = 3"));
    EXPECT_NE(two.find("'kb1_all' counts successes of 2 already"), std::string::npos) << two;
    std::string const own = complaint("all_of = \"kb1\"", "all_of = \"kb1\"\noptions = [\"--success\", \"2\"]\n" +
                                                              revalued("a", "kb1_all", "\"contrast\"\nsuccess = 2"));
    EXPECT_NE(own.find("the options of 'kb1_all' have --success"), std::string::npos) << own;
    std::string many;
    for (int i = 0; i < 14; ++i)
        many += revalued(std::string(1, static_cast<char>('a' + i)), "kb1",
                         std::string{"\"return\"\ngamma = 0."}.append(std::to_string(10 + i)));
    EXPECT_NE(complaint_of(many).find("more than 16 gammas"), std::string::npos);
    EXPECT_NE(complaint_of("[[knowledge]]\nname = \"x\"\nrevalued_of = \"kb1\"\n").find("value"), std::string::npos);
}

TEST_F(Campaign, opens_the_world_of_every_treatment_before_the_first_run) {
    auto const complaint = [&] { return test::complaint_of<UsageError>([&] { check_worlds(plan()); }); };
    EXPECT_NO_THROW(check_worlds(plan()));
    write("target.toml", "name = \"target\"\n[world]\nlibrary = \"nowhere\"\n");
    EXPECT_NE(complaint().find("cannot open the world of treatment 'none'"), std::string::npos) << complaint();
    EXPECT_NE(complaint().find("nowhere"), std::string::npos);
    write("target.toml", "name = \"target\"\n[world]\nlibrary = \"" + test::c_world("pendulum") + "\"\n");
    EXPECT_NE(complaint().find("treatment 'kb1' cannot take knowledge = 'kb1'"), std::string::npos) << complaint();
    write("source.toml", "name = \"source\"\n[world]\nlibrary = \"" + test::c_world("pendulum") + "\"\n");
    EXPECT_NO_THROW(check_worlds(plan())) << "all in one world";
}

TEST_F(Campaign, wishes_for_any_reward_and_times_levels_that_increase) {
    std::string text = test::small_campaign;
    text.replace(text.find("balls = 6"), 9, "reward = -12.5");
    write("campaign.toml", text + "levels = [-20.5, 0, 3]\n");
    EXPECT_EQ(plan().knowledge_base("kb1").wished_reward, -12.5);
    EXPECT_EQ(plan().levels, (std::vector<double>{-20.5, 0, 3}));
    write("campaign.toml", test::small_campaign + "levels = [1, 1]\n");
    EXPECT_NE(test::complaint_of<UsageError>([&] { plan(); }).find("levels"), std::string::npos);
}

TEST_F(Campaign, has_every_kind_of_knowledge_and_input_of_treatments_in_its_documentation) {
    std::string const page = read(LORE_SOURCE_DIR "/docs/manual/campaigns.md");
    for (KnowledgeKindRow const& kind : knowledge_kinds())
        EXPECT_NE(page.find("| `" + std::string{kind.key} + "` |"), std::string::npos) << kind.key;
    for (TreatmentInput const& input : treatment_inputs())
        EXPECT_NE(page.find("| `" + std::string{input.key} + "` |"), std::string::npos) << input.key;
}
