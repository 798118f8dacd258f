#include <lore/report/report.h>

#include "campaign/campaign_fixture.h"
#include "support/complaint.h"

#include <lore/campaign/replay.h>
#include <lore/experiment/progress_file.h>
#include <lore/world/reward_text.h>

#include <gmock/gmock.h>

#include <set>

using namespace lore;

class Report : public test::CampaignTest {
protected:
    std::string made(std::string const& name, std::string const& where = "c") const {
        return read(scratch.file(where + "/" + name));
    }
    /// In place of what the fake made up: no ball at first, then so many until generation 20.
    void write_rewards(std::string const& step, double reward, std::string_view unit = first_reward_unit) const {
        std::string table = progress_header(unit) + "\n";
        for (int generation = 0; generation <= 20; ++generation) {
            GenerationSummary row;
            row.generation = generation;
            row.best_reward = generation == 0 ? 0 : reward;
            row.evaluations = 400 + 200ull * static_cast<unsigned>(generation);
            table += text(row) + "\n";
        }
        write("c/runs/" + step + "/progress.csv", table);
    }
    int rows(std::string const& name) const {
        std::string const text = made(name);
        return static_cast<int>(std::count(text.begin(), text.end(), '\n')) - 1;
    }
};

TEST_F(Report, has_a_row_for_every_finished_run) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    EXPECT_TRUE(made("final.csv").starts_with("treatment,run,seed,balls\nsource,1,1,"));
    EXPECT_EQ(rows("final.csv"), 4 + 9);
    EXPECT_EQ(rows("curves.csv"), 4 * 21);
    EXPECT_EQ(rows("pvalues.csv"), 3);
    EXPECT_EQ(rows("kbs.csv"), 5);
    EXPECT_TRUE(made("population.csv").starts_with("treatment,generation,runs,mean_balls,fronts,tied,"));
    EXPECT_EQ(rows("population.csv"), 4 * 6) << "generations 0, 1, 2, 5, 10 and 20";
    EXPECT_TRUE(
        made("speed.csv").starts_with("treatment,runs,generations,reached_1,time_1,time_1_low,time_1_high,median_1,"));
    EXPECT_EQ(rows("speed.csv"), 3);
    EXPECT_EQ(rows("leads.csv"), 0) << "there is no policy";
    EXPECT_NE(made("report.html").find("restricted mean"), std::string::npos);
    for (char const* name : {"report.html", "figures/figure3.svg", "figures/figure3.png", "figures/figure4.svg",
                             "figures/figure4.png", "summary.json"})
        EXPECT_FALSE(made(name).empty()) << name;
}

TEST_F(Report, is_self_contained_with_unique_ids) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    std::string const page = made("report.html");
    for (char const* outside : {"src=\"", "@import", "url(", "href=\"http"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    std::set<std::string> ids;
    for (std::size_t at = page.find(" id=\""); at != std::string::npos; at = page.find(" id=\"", at + 1))
        EXPECT_TRUE(ids.insert(page.substr(at + 5, page.find('"', at + 5) - at - 5)).second) << page.substr(at, 40);
    EXPECT_NE(page.find("13 of 13 runs finished"), std::string::npos);
}

TEST_F(Report, works_over_an_unfinished_campaign_and_says_so) {
    RunnerOptions some = options();
    some.only = {"source/001", "source/003", "none/002"};
    ASSERT_EQ(run_campaign(plan(), directory(), some), ExitCode::done);
    write_report(plan(), directory());
    EXPECT_EQ(rows("final.csv"), 3);
    EXPECT_EQ(rows("pvalues.csv"), 0);
    EXPECT_NE(made("report.html").find("3 of 13 runs finished"), std::string::npos);
    EXPECT_NE(made("report.html").find("not complete"), std::string::npos);
}

TEST_F(Report, has_no_standard_deviation_of_one_run) {
    RunnerOptions some = options();
    some.only = {"none/002"};
    ASSERT_EQ(run_campaign(plan(), directory(), some), ExitCode::done);
    write_report(plan(), directory());
    EXPECT_THAT(made("summary.json"), ::testing::HasSubstr("\"standard_deviation\": null"));
}

TEST_F(Report, tells_programs_the_label_of_a_knowledge_base_that_is_not_its_name) {
    std::string text = test::small_campaign;
    write("campaign.toml", text.replace(text.find("balls = 6"), 9, "balls = 6\nlabel = \"the best\""));
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    std::string const summary = made("summary.json");
    EXPECT_THAT(summary, ::testing::ContainsRegex("\"knowledge\": \"kb1\",\n *\"label\": \"the best\""));
    EXPECT_THAT(summary, ::testing::ContainsRegex("\"knowledge\": \"kb2\",\n *\"kind\""));
}

TEST_F(Report, keeps_no_figure_of_a_former_one) {
    RunnerOptions some = options();
    some.only = {"source"};
    ASSERT_EQ(run_campaign(plan(), directory(), some), ExitCode::done);
    std::filesystem::create_directories(scratch.file("c/figures"));
    write("c/figures/figure5.svg", "of a campaign with other bases");
    write("c/figures/figure3_pole.svg", "of a campaign with a task more");
    write("c/summary.json", R"({"treatments": [{"treatment": "pole_from_none", "target": "pole"}]})");
    write("c/figures/figure3_for_a_talk.svg", "of the user");
    write_report(plan(), directory());
    EXPECT_FALSE(std::filesystem::exists(scratch.file("c/figures/figure3_pole.svg")));
    EXPECT_TRUE(std::filesystem::exists(scratch.file("c/figures/figure3_for_a_talk.svg")));
    EXPECT_FALSE(std::filesystem::exists(scratch.file("c/figures/figure5.svg")));
    EXPECT_TRUE(std::filesystem::exists(scratch.file("c/figures/figure3.svg")));
}

TEST_F(Report, is_the_same_to_the_byte_when_made_again_from_the_csv_files_alone) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    std::filesystem::create_directories(scratch.file("kept"));
    for (char const* name :
         {"final.csv", "runs.csv", "curves.csv", "population.csv", "kbs.csv", "speed.csv", "leads.csv"})
        std::filesystem::copy_file(scratch.file(std::string{"c/"} + name), scratch.file(std::string{"kept/"} + name));
    write_report(plan(), directory("kept"));
    for (char const* name :
         {"report.html", "pvalues.csv", "summary.json", "figures/figure3.svg", "figures/figure4.svg"})
        EXPECT_EQ(made(name), made(name, "kept")) << name;
}

TEST_F(Report, can_be_written_elsewhere_so_that_campaigns_can_share_their_runs) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory(), directory("elsewhere"));
    EXPECT_FALSE(std::filesystem::exists(scratch.file("c/final.csv")));
    write_report(plan(), directory());
    for (char const* name : {"report.html", "final.csv", "kbs.csv", "figures/figure3.svg"})
        EXPECT_EQ(made(name), made(name, "elsewhere")) << name;
    write_report(plan(), directory("elsewhere"), directory("third"));
    EXPECT_EQ(made("report.html"), made("report.html", "third")) << "from tables without runs";
    EXPECT_FALSE(std::filesystem::exists(scratch.file("third/final.csv")));
    write("file", "");
    EXPECT_THROW(write_report(plan(), directory(), directory("file")), Error) << "where no directory can be made";
}

TEST_F(Report, says_how_much_of_the_policys_lead_a_base_has) {
    write("campaign.toml", std::string{test::small_campaign}.replace(
                               test::small_campaign.find("knowledge = \"kb1_all\""), 21, "policy_of = \"kb1\""));
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write("c/leads.csv", "of a former report");
    for (int run = 1; run <= 3; ++run) {
        write_rewards(run_step("none", run), 2);
        write_rewards(run_step("all", run), 6);
        write_rewards(run_step("kb1", run), 5);
    }
    write_report(plan(), directory());
    EXPECT_EQ(made("leads.csv"), "treatment,policy,none,generation,balls,policy_balls,none_balls,share\n"
                                 "kb1,all,none,1,5.0000,6.0000,2.0000,0.7500\n"
                                 "kb1,all,none,2,5.0000,6.0000,2.0000,0.7500\n"
                                 "kb1,all,none,5,5.0000,6.0000,2.0000,0.7500\n"
                                 "kb1,all,none,10,5.0000,6.0000,2.0000,0.7500\n"
                                 "kb1,all,none,20,5.0000,6.0000,2.0000,0.7500\n");
    EXPECT_NE(made("report.html").find("id=\"leads\""), std::string::npos);
    EXPECT_NE(made("summary.json").find("\"share\": 0.75"), std::string::npos);
}

TEST_F(Report, of_the_published_tables_is_the_published_one) {
    // But for the line that names the program that made it, and its scripts.
    auto const shown = [](std::string page) {
        std::size_t const line = page.find("<p>Runs: Lore");
        if (line != std::string::npos) page.erase(line, page.find('\n', line) - line);
        for (std::size_t script = 0; (script = page.find("<script", script)) != std::string::npos;)
            page.erase(script, page.find("</script>", script) - script);
        return page;
    };
    std::vector<std::filesystem::path> published;
    for (auto const& entry : std::filesystem::directory_iterator{LORE_SOURCE_DIR "/docs/results"})
        if (entry.is_directory()) published.push_back(entry.path());
    ASSERT_GE(published.size(), 14u);
    for (std::filesystem::path const& kept : published) {
        std::string const name = kept.filename();
        write_report(read_campaign(LORE_SOURCE_DIR "/jobs/campaigns/" + name + ".toml"), CampaignDirectory{kept},
                     directory(name));
        for (char const* file :
             {"pvalues.csv", "summary.json", "pools.csv", "matrix.csv"})   // the last two of some alone
            EXPECT_EQ(made(file, name), read(kept / file)) << name << '/' << file;
        std::string const page = made("report.html", name);
        EXPECT_FALSE(page.empty());
        if (name == "paper") { EXPECT_EQ(shown(page), shown(read(kept / "report.html"))); }
        for (auto const& entry : std::filesystem::directory_iterator{kept}) {
            std::string const file = entry.path().filename();
            if (file.ends_with(".svg")) {
                EXPECT_EQ(made("figures/" + file, name), read(entry.path())) << name << '/' << file;
            }
        }
    }
}

TEST_F(Report, has_pools_where_the_campaign_has_them_and_nothing_of_them_else) {
    std::string const without = read(scratch.file("campaign.toml"));
    write("campaign.toml", without + "[[pool]]\nname = \"with\"\nlabel = \"with knowledge\"\n"
                                     "treatments = [\"kb1\", \"all\"]\nagainst = [\"none\"]\n");
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    EXPECT_TRUE(made("pools.csv").starts_with("a,b,n_a,n_b,u,p,p_holm,a12,a12_low,a12_high\nwith,none,6,3,"));
    EXPECT_EQ(rows("pools.csv"), 1);
    EXPECT_NE(made("report.html").find(">with knowledge</td><td class=\"text\">KB1, all</td>"), std::string::npos);
    EXPECT_NE(made("report.html").find("id=\"planned\""), std::string::npos);
    EXPECT_NE(made("summary.json").find("\"planned\""), std::string::npos);
    std::string const pairs = made("pvalues.csv");

    write("campaign.toml", without);
    write_report(plan(), directory());
    EXPECT_FALSE(std::filesystem::exists(scratch.file("c/pools.csv")));
    EXPECT_EQ(made("pvalues.csv"), pairs) << "pools change nothing else";
    for (char const* word : {"Pooled", "id=\"planned\"", "<!--"})
        EXPECT_EQ(made("report.html").find(word), std::string::npos) << word;
    EXPECT_EQ(made("summary.json").find("\"pools\""), std::string::npos);
}

TEST_F(Report, shows_pools_for_their_treatments_where_the_campaign_asks_for_it) {
    std::string const text = test::small_campaign + "figure3 = [\"with\", \"none\"]\n" +
                             "[[pool]]\nname = \"with\"\nlabel = \"with knowledge\"\n" +
                             "treatments = [\"kb1\", \"all\"]\nagainst = [\"none\"]\n";
    write("campaign.toml", text);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory(), directory("again"));
    for (char const* figure : {"figures/figure3.svg", "figures/figure4.svg"}) {
        std::string const svg = made(figure, "again");
        EXPECT_THAT(svg, ::testing::HasSubstr("with knowledge")) << figure;
        EXPECT_THAT(svg, ::testing::HasSubstr("n = 6")) << figure;
        EXPECT_THAT(svg, ::testing::Not(::testing::HasSubstr("KB1"))) << figure;
    }
    EXPECT_THAT(made("summary.json", "again"), ::testing::HasSubstr("\"figure3\""));
    auto const last_mean = [&](std::string const& name) {
        std::istringstream lines{made("curves.csv", "again")};
        std::string line, last;
        while (std::getline(lines, line))
            if (line.starts_with(name + ",20,")) last = line;
        std::istringstream fields{last};
        for (int field = 0; field < 4; ++field) std::getline(fields, line, ',');
        return std::stod(line);
    };
    EXPECT_NEAR(last_mean("with"), (last_mean("kb1") + last_mean("all")) / 2, 1e-3) << "three runs each";
    std::string const figure = made("figures/figure3.svg", "again");
    write_report(plan(), directory("again"));
    EXPECT_EQ(made("figures/figure3.svg", "again"), figure) << "from the tables alone";

    for (auto const& [names, words] :
         {std::pair{"[\"none\", \"none\"]", "names 'none' twice"}, std::pair{"[\"nobody\"]", "'nobody'"}}) {
        std::string wrong = text;
        write("campaign.toml", wrong.replace(wrong.find("[\"with\", \"none\"]"), 16, names));
        EXPECT_THAT(test::complaint_of<UsageError>([&] { plan(); }), ::testing::HasSubstr(words));
    }
}

TEST_F(Report, needs_no_more_than_the_final_rewards_and_the_curves) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    std::filesystem::create_directories(scratch.file("kept"));
    for (char const* name : {"final.csv", "curves.csv"})
        std::filesystem::copy_file(scratch.file(std::string{"c/"} + name), scratch.file(std::string{"kept/"} + name));
    write_report(plan(), directory("kept"));
    for (char const* name : {"pvalues.csv", "figures/figure3.svg", "figures/figure4.svg"})
        EXPECT_EQ(made(name), made(name, "kept")) << name;
}

TEST_F(Report, refuses_a_directory_without_results_and_damaged_tables) {
    EXPECT_THROW(write_report(plan(), directory("nothing")), Error);
    std::filesystem::create_directories(scratch.file("kept"));
    write("kept/curves.csv", "treatment,generation,runs,mean,low,high\nkb1,0,3,1,0.5\n");
    write("kept/final.csv", "treatment,run,seed,balls\nkb1,1,1,three\n");
    EXPECT_THROW(write_report(plan(), directory("kept")), Error);
    write("kept/final.csv", "treatment,run,seed,balls\nkb1,1,1,3\n");
    EXPECT_THROW(write_report(plan(), directory("kept")), Error);
    write("kept/curves.csv", "treatment,generation,runs,mean,low,high\nkb1,0,3,1,0.5,1.5\n");
    write("kept/final.csv", "treatment,run,seed,balls\nkb9,1,1,3\n");
    EXPECT_THROW(write_report(plan(), directory("kept")), Error) << "a treatment that the campaign does not know";
    write("kept/final.csv", "treatment,run,seed,balls\nkb1,1,1,3\n");
    write("kept/population.csv", "treatment,generation,runs,mean_balls,fronts,tied,best_shaping,shaping_at_max,"
                                 "connections,hidden\nkb9,0,1,1,1,0,-1,1,15,0\n");
    EXPECT_THAT(test::complaint_of([&] { write_report(plan(), directory("kept")); }),
                ::testing::HasSubstr("population.csv tells of a treatment 'kb9'"));
}

TEST_F(Report, refuses_a_campaign_that_none_of_the_runs_belongs_to_and_keeps_the_tables) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    std::string const tables = made("final.csv");
    std::string text = test::small_campaign;
    text.replace(text.find("generations = 20"), 16, "generations = 10");
    write("campaign.toml", text);
    EXPECT_THAT(test::complaint_of([&] { write_report(plan(), directory()); }),
                ::testing::HasSubstr("was made with evolution.generations"));
    EXPECT_EQ(made("final.csv"), tables);
}

TEST_F(Report, of_another_reward_has_its_unit_and_can_be_made_again_from_its_tables) {
    write("campaign.toml", test::small_campaign + "[[pool]]\nname = \"with\"\ntreatments = [\"kb1\", \"all\"]\n"
                                                  "against = [\"none\"]\n");
    ::setenv("LORE_FAKE_UNIT", "cos", 1);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ::unsetenv("LORE_FAKE_UNIT");
    write_report(plan(), directory());
    EXPECT_TRUE(made("final.csv").starts_with("treatment,run,seed,reward,unit\nsource,1,1,-")) << made("final.csv");
    EXPECT_TRUE(made("population.csv").starts_with("treatment,generation,runs,mean_reward,"));
    EXPECT_TRUE(made("speed.csv").starts_with("treatment,runs,generations,level_1,reached_1,time_1,"));
    EXPECT_NE(made("knowledge/choice.json").find("\"reward_unit\": \"cos\""), std::string::npos);
    std::string const page = made("report.html");
    EXPECT_NE(page.find("Reward [cos] of the best-of-runs"), std::string::npos);
    EXPECT_NE(page.find("Reward [cos] of the best-of-runs at the last generation, of the runs of several treatments"),
              std::string::npos);
    EXPECT_NE(page.find("[cos x generations]"), std::string::npos);
    EXPECT_NE(made("figures/figure4.svg").find("reward [cos] (best-of-run)"), std::string::npos);
    for (std::string const& text :
         {page, made("summary.json"), made("runs.csv"), made("kbs.csv"), made("leads.csv"), made("pools.csv")})
        EXPECT_EQ(text.find("balls"), std::string::npos) << text.substr(std::min(text.size(), text.find("balls")), 80);

    std::filesystem::create_directories(scratch.file("kept"));
    for (auto const& entry : std::filesystem::directory_iterator{scratch.file("c")})
        if (entry.path().extension() == ".csv")
            std::filesystem::copy_file(entry.path(), scratch.file("kept/" + entry.path().filename().string()));
    write_report(plan(), directory("kept"), directory("again"));
    for (char const* name : {"report.html", "summary.json", "figures/figure3.svg", "figures/figure4.svg"})
        EXPECT_EQ(made(name), made(name, "again")) << name;
}

TEST_F(Report, of_a_unit_with_a_comma_can_be_made_again_from_its_tables) {
    ::setenv("LORE_FAKE_UNIT", "5\" steps, forward", 1);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ::unsetenv("LORE_FAKE_UNIT");
    write_report(plan(), directory());
    EXPECT_NE(made("final.csv").find(",\"5\"\" steps, forward\"\n"), std::string::npos) << made("final.csv");
    EXPECT_NE(made("report.html").find("Reward [5&quot; steps, forward]"), std::string::npos);
    std::filesystem::create_directories(scratch.file("kept"));
    for (auto const& entry : std::filesystem::directory_iterator{scratch.file("c")})
        if (entry.path().extension() == ".csv")
            std::filesystem::copy_file(entry.path(), scratch.file("kept/" + entry.path().filename().string()));
    write_report(plan(), directory("kept"), directory("again"));
    EXPECT_EQ(made("report.html"), made("report.html", "again"));
}

TEST_F(Report, refuses_a_pool_of_rewards_of_different_units) {
    write("campaign.toml", test::small_campaign + "[[pool]]\nname = \"both\"\ntreatments = [\"kb1\", \"all\"]\n");
    std::filesystem::create_directories(scratch.file("kept"));
    write("kept/curves.csv", "treatment,generation,runs,mean,low,high\nkb1,0,1,3,3,3\nall,0,1,-1,-1,-1\n");
    write("kept/final.csv", "treatment,run,seed,reward,unit\nkb1,1,1,3,balls\nall,1,1,-1,cos\n");
    EXPECT_THAT(test::complaint_of<UsageError>([&] { write_report(plan(), directory("kept"), directory("out")); }),
                ::testing::HasSubstr("pool 'both'"));
}

TEST_F(Report, compares_no_treatments_of_different_units) {
    std::filesystem::create_directories(scratch.file("kept"));
    write("kept/curves.csv",
          "treatment,generation,runs,mean,low,high\nkb1,0,1,3,3,3\nall,0,1,-1,-1,-1\nnone,0,1,2,2,2\n");
    write("kept/final.csv", "treatment,run,seed,reward,unit\nkb1,1,1,3,balls\nall,1,1,-1,cos\nnone,1,1,2,balls\n");
    write_report(plan(), directory("kept"), directory("out"));
    std::string const pairs = made("pvalues.csv", "out");
    EXPECT_EQ(std::count(pairs.begin(), pairs.end(), '\n'), 2) << pairs;
    EXPECT_NE(pairs.find("\nnone,kb1,1,1,"), std::string::npos) << pairs;
    std::string const page = made("report.html", "out");
    EXPECT_THAT(page, ::testing::Not(::testing::HasSubstr("not tested"))) << "of two treatments that were";
    EXPECT_THAT(page, ::testing::HasSubstr("comparisons. Left out, as rewards of another unit: all.</figcaption>"));
}

TEST_F(Report, times_no_treatments_of_different_units_together) {
    RunnerOptions some = options();
    some.only = {"none"};
    ASSERT_EQ(run_campaign(plan(), directory(), some), ExitCode::done);
    ::setenv("LORE_FAKE_UNIT", "cos", 1);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ::unsetenv("LORE_FAKE_UNIT");
    write_report(plan(), directory());
    EXPECT_NE(made("speed.csv").find("\nnone,"), std::string::npos) << made("speed.csv");
    EXPECT_EQ(rows("speed.csv"), 1);
    EXPECT_THAT(made("report.html"),
                ::testing::HasSubstr("with its interval. Left out, as rewards of another unit: all, KB1.</p>"));
}

TEST_F(Report, has_no_words_on_times_where_no_level_is_timed) {
    ::setenv("LORE_FAKE_UNIT", "cos", 1);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ::unsetenv("LORE_FAKE_UNIT");
    for (char const* name : {"none", "all", "kb1"})
        for (int run = 1; run <= 3; ++run) write_rewards(run_step(name, run), -3, "cos");
    write_report(plan(), directory());
    EXPECT_THAT(made("report.html"), ::testing::HasSubstr("<p class=\"note\">Area: "));
    EXPECT_EQ(made("report.html").find("To :"), std::string::npos);
}

TEST_F(Report, replaces_no_table_where_it_is_refused) {
    write("campaign.toml", test::small_campaign + "[[pool]]\nname = \"both\"\ntreatments = [\"kb1\", \"none\"]\n");
    RunnerOptions some = options();
    some.only = {"none"};
    ASSERT_EQ(run_campaign(plan(), directory(), some), ExitCode::done);
    write_report(plan(), directory());
    std::string const runs = made("runs.csv"), curves = made("curves.csv");
    ::setenv("LORE_FAKE_UNIT", "cos", 1);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ::unsetenv("LORE_FAKE_UNIT");
    EXPECT_THAT(test::complaint_of<UsageError>([&] { write_report(plan(), directory()); }),
                ::testing::HasSubstr("pool 'both'"));
    EXPECT_EQ(made("runs.csv"), runs);
    EXPECT_EQ(made("curves.csv"), curves);
}

TEST_F(Report, shows_the_path_of_another_world_over_its_scene) {
    ::setenv("LORE_FAKE_UNIT", "cos", 1);
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    ::unsetenv("LORE_FAKE_UNIT");
    Replay replay{"source/001", "00000000000000aa", "cos", {2, 1, "<g id=\"pole\"></g>"}, {}, {}};
    for (int k = 0; k < 40; ++k) replay.steps.push_back({0.05f * static_cast<float>(k), 0.5f, -0.25 * k});
    write_replays(directory(),
                  {{replay}, {{"figure5", "kb1", {-0.5, -0.25}, "c"}, {"figure6", "kb1*kb2", {0.5, 0.25}, "c"}}});
    write("campaign.toml", test::small_campaign + "trajectory = \"kb1\"\n");
    write_report(plan(), directory());
    std::string const page = made("report.html"), figure = made("figures/figure5.svg");
    EXPECT_NE(figure.find("<g id=\"pole\"></g>"), std::string::npos);
    EXPECT_NE(page.find("%3Cg%20id%3D%22pole%22%3E%3C%2Fg%3E"), std::string::npos) << "as an image";
    EXPECT_EQ(page.find("<g id=\"pole\""), std::string::npos) << "where a scene could run scripts";
    EXPECT_NE(figure.find("value (cos)"), std::string::npos);
    EXPECT_EQ(figure.find("stroke=\"#08306b\" stroke-width=\"2.8\""), std::string::npos) << "which is for 0";
    EXPECT_NE(figure.find("stroke=\"#deebf7\" stroke-width=\"2.8\""), std::string::npos) << "the lowest value";
    EXPECT_THAT(page,
                ::testing::HasSubstr("alt=\"Path of the best-of-run of source/001, colored by the values of kb1\""));
    EXPECT_THAT(made("figures/figure6.svg"), ::testing::HasSubstr("product of the values (cos\u00b2)"));
    EXPECT_EQ(page.find("(-1: not found)"), std::string::npos) << "as -1 is a value here";
    EXPECT_NE(page.find("\"world\":{\"width\":2.0"), std::string::npos);
    EXPECT_NE(page.find("\\u003cg id=\\\"pole\\\">"), std::string::npos) << "which cannot end the script";
    EXPECT_NE(page.find("[39,-9.75]"), std::string::npos) << "the reward so far";
    EXPECT_NE(page.find("encodeURIComponent(scene)"), std::string::npos) << "the script for worlds";
    EXPECT_EQ(page.find("balls"), std::string::npos);
    write("campaign.toml", test::small_campaign);
    write_report(plan(), directory());
    EXPECT_EQ(made("report.html").find("id=\"replay\""), std::string::npos) << "it is no longer asked for";
    EXPECT_FALSE(std::filesystem::exists(scratch.file("c/figures/figure5.svg")));
}

TEST_F(Report, shows_whole_windows_of_a_life_that_their_length_does_not_divide) {
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    Replay replay{"source/001", "00000000000000aa", "balls", {}, {}, ArenaReplay{}};
    replay.arena->scene.width = replay.arena->scene.height = 45;
    replay.arena->scene.basket_lights = {{0, 0}};
    replay.arena->steps.resize(45);
    for (int k = 0; k < 45; ++k) replay.steps.push_back({static_cast<float>(k), static_cast<float>(k % 2), 0});
    double const none = std::numeric_limits<double>::quiet_NaN();
    write_replays(directory(), {{replay}, {{"figure5", "kb1", {-0.5, none}, "c", 20}}});
    write("campaign.toml", test::small_campaign + "trajectory = \"kb1\"\n");
    write_report(plan(), directory());
    EXPECT_NE(made("report.html").find("\"values\":[-0.5,null],\"window_length\":20"), std::string::npos);
    // Of the path, window by window: the line of the first in its color, the others in gray.
    std::string const figure = made("figures/figure5.svg");
    auto const lines = [&](std::string const& stroke) {
        int count = 0;
        for (std::size_t at = figure.find("<polyline"); at != std::string::npos; at = figure.find("<polyline", at + 1))
            count +=
                figure.substr(at, figure.find("/>", at) - at).find("stroke=\"" + stroke + "\"") != std::string::npos;
        return count;
    };
    EXPECT_EQ(lines("#4d4d4d"), 1) << "a negative value is found, too";
    EXPECT_EQ(lines("#8c8c8c"), 2);
    EXPECT_NE(figure.find("not in the knowledge base<"), std::string::npos) << "at no value";
}
