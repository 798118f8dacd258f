#include "matrix.h"
#include "task_parts.h"

#include <lore/report/report.h>

#include "campaign/campaign_fixture.h"
#include "support/c_worlds.h"
#include "support/complaint.h"

#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

/// Two source tasks and two target tasks; knowledge of b does not fit y.
CampaignPlan two_by_two() {
    CampaignPlan plan;
    for (char const* name : {"a", "b"}) {
        Treatment& source = plan.sources.emplace_back();
        source.name = name;
        source.label = std::string{"source "} + name;
    }
    for (char const* name : {"x", "y"}) {
        Treatment& task = plan.tasks.emplace_back();
        task.name = task.target = name;
        task.label = std::string{"target "} + name;
    }
    for (char const* name : {"x_from_none", "x_from_a", "x_from_b", "y_from_none", "y_from_a"}) {
        Treatment& treatment = plan.targets.emplace_back();
        treatment.name = name;
        treatment.target = std::string{name}.substr(0, 1);
        treatment.label = "target " + treatment.target + ": " + std::string{name}.substr(2);
        treatment.runs = 3;
        plan.report_order.push_back(name);
    }
    plan.transfer = {{"a", "x", "x_from_a", "x_from_none", ""},
                     {"a", "y", "y_from_a", "y_from_none", ""},
                     {"b", "x", "x_from_b", "x_from_none", ""},
                     {"b", "y", "", "y_from_none", "made for 2 sensors and 1 effectors, not for 3 and 1"}};
    return plan;
}

Results some_results() {
    Results results;
    auto const add = [&](std::string const& treatment, std::vector<double> const& rewards, std::string const& unit) {
        for (double const reward : rewards) results.runs.push_back({treatment, 1, 1, reward, 50, 0, "", "", unit});
    };
    add("x_from_none", {1, 2, 3}, "way");
    add("x_from_a", {4, 5, 6}, "way");
    add("x_from_b", {1, 2, 3}, "way");
    add("y_from_none", {-10, -11}, "cos");
    return results;
}

}   // namespace

TEST(Matrix, compares_each_treatment_with_the_one_without_knowledge_on_the_same_task) {
    auto const fields = transfer_matrix(two_by_two(), some_results());
    ASSERT_EQ(fields.size(), 4u);
    MatrixField const& better = fields[0];
    EXPECT_EQ(better.difference, 3);
    EXPECT_EQ(better.mean_none, 2);
    EXPECT_EQ(better.n, 3);
    EXPECT_EQ(better.generation, 50);
    EXPECT_EQ(better.unit, "way");
    EXPECT_GT(better.difference_band.low, 1);
    EXPECT_LT(better.difference_band.high, 5);
    EXPECT_EQ(better.a12, 1);
    EXPECT_EQ(better.a12_band.low, 1);
    EXPECT_NEAR(better.p, 0.1, 1e-12) << "2 of the 20 ways to choose three of six";
    EXPECT_NEAR(better.p_holm, 0.2, 1e-12) << "two fields have numbers";
    EXPECT_EQ(fields[2].difference, 0);
    EXPECT_EQ(fields[2].a12, 0.5);
    EXPECT_EQ(fields[2].p_holm, 1);
    EXPECT_EQ(fields[1].why, "no runs yet");
    EXPECT_EQ(fields[3].why, "other channels");
    EXPECT_EQ(count_text(fields, &MatrixField::n), "3");
}

TEST(Matrix, is_a_table_with_empty_places_where_there_are_no_numbers) {
    std::string const text = matrix_csv(transfer_matrix(two_by_two(), some_results()));
    EXPECT_THAT(text, HasSubstr("source,target,treatment,none,unit,generation,n,n_none,mean,mean_none,difference,"));
    EXPECT_THAT(text, HasSubstr("\na,x,x_from_a,x_from_none,way,50,3,3,5,2,3,"));
    EXPECT_THAT(text, HasSubstr("\na,y,y_from_a,y_from_none,,,,,,,,,,,,,,,no runs yet\n"));
    EXPECT_THAT(text, HasSubstr("\nb,y,,y_from_none,,,,,,,,,,,,,,,other channels\n"));
    std::string const first = text.substr(0, text.find('\n'));
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
        EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                             text.begin() + static_cast<std::ptrdiff_t>(text.find('\n', at)), ','),
                  std::count(first.begin(), first.end(), ','));
}

TEST(Matrix, of_a_former_report_says_what_does_not_fit) {
    CampaignPlan plan = two_by_two();
    plan.transfer[1].misfit.clear();
    Results results = some_results();
    results.misfits = {{"a", "y"}, {"a", "x"}};
    CampaignPlan const known = without_misfits(plan, results);
    EXPECT_EQ(known.transfer[1].misfit, "other channels");
    EXPECT_EQ(known.transfer[1].treatment, "");
    EXPECT_EQ(known.transfer[0].treatment, "x_from_a") << "which has runs";
    EXPECT_EQ(known.targets.size(), 4u);
    EXPECT_EQ(known.report_order, (std::vector<std::string>{"x_from_none", "x_from_a", "x_from_b", "y_from_none"}));
}

TEST(Matrix, is_drawn_with_numbers_labels_and_a_color_by_a12) {
    std::string const svg = draw_matrix(two_by_two(), transfer_matrix(two_by_two(), some_results()));
    for (char const* word :
         {">+3.00<", ">target x<", ">source b<", ">way, generation 50<", ">other channels<", ">no runs yet<",
          ">A12 1.00 (1.00 .. 1.00)<", ">p = 0.200<", "fill=\"#5c9cd6\"", "fill=\"#ffffff\""})
        EXPECT_THAT(svg, HasSubstr(word));
}

TEST(Matrix, breaks_long_labels_of_tasks_into_lines) {
    CampaignPlan plan = two_by_two();
    plan.tasks[0].label = "COLLECTBALL TARGET TASK WITHOUT A DOOR";
    plan.sources[1].label = "WWMM MEDIUM MAZE WITH WIDE LETTERS";
    std::string const svg = draw_matrix(plan, transfer_matrix(plan, some_results()));
    for (char const* line : {">COLLECTBALL TARGET<", ">TASK WITHOUT A<", ">WWMM MEDIUM MAZE WITH<", ">target y<"})
        EXPECT_THAT(svg, HasSubstr(line));
}

TEST(Matrix, writes_differences_with_their_sign_and_three_digits_of_the_largest) {
    MatrixField field;
    field.difference = 1.256;
    field.difference_band = {-0.5, 12.34};
    EXPECT_EQ(difference_text(field), "+1.3");
    EXPECT_EQ(difference_band_text(field), "-0.5 .. +12.3");
    field.difference = -0.00123;
    field.difference_band = {-0.0054, 0};
    EXPECT_EQ(difference_text(field), "-0.00123");
    EXPECT_EQ(difference_band_text(field), "-0.00540 .. 0");
    field.difference = 1234.4;
    EXPECT_EQ(difference_text(field), "+1234");
}

TEST(TaskParts, have_the_treatments_of_one_task_with_short_labels) {
    CampaignPlan const plan = two_by_two();
    Results const results = some_results();
    auto const comparisons = compare_treatments(plan, results);
    ASSERT_EQ(comparisons.size(), 3u) << "none between tasks";
    auto const parts = task_parts(plan, results, comparisons);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].figure("figure3"), "figure3_x");
    EXPECT_EQ(parts[0].plan.treatment("x_from_a").label, "from_a");
    EXPECT_EQ(parts[0].results.runs.size(), 9u);
    EXPECT_EQ(parts[0].comparisons.size(), 3u);
    EXPECT_EQ(parts[1].results.reward_unit(parts[1].plan), "cos");
    EXPECT_TRUE(results.has_several_units(plan));
}

class MatrixReport : public test::CampaignTest {
protected:
    std::string made(std::string const& name, std::string const& where = "c") const {
        return read(scratch.file(where + "/" + name));
    }
};

TEST_F(MatrixReport, can_be_made_again_from_its_tables_where_a_world_is_not_at_hand) {
    std::string const pole = "name = \"pole\"\n[world]\nlibrary = \"";
    write("pole.toml", pole + test::c_world("pendulum") + "\"\n");
    write("campaign.toml", "title = \"Two worlds\"\nruns = 3\ngenerations = 20\n"
                           "[[source]]\nname = \"arena\"\nconfig = \"source.toml\"\n"
                           "[[source]]\nname = \"pole\"\nlabel = \"the <pole>\"\nconfig = \"pole.toml\"\n"
                           "[[target]]\nname = \"arena\"\nlabel = \"the arena\"\nconfig = \"target.toml\"\n"
                           "[[target]]\nname = \"pole\"\nconfig = \"pole.toml\"\nfirst_seed = 101\n"
                           "[transfer]\nmethod = \"shaping\"\n");
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    EXPECT_THAT(made("matrix.csv"), HasSubstr("\narena,arena,arena_from_arena,arena_from_none,balls,20,3,3,"));
    EXPECT_THAT(made("matrix.csv"), HasSubstr("\narena,pole,,pole_from_none,,,,,,,,,,,,,,,other channels\n"));
    EXPECT_THAT(made("final.csv"), HasSubstr("\npole,1,1,"));
    std::string const page = made("report.html");
    for (char const* word :
         {"18 of 18 runs finished", "id=\"transfer\"", "id=\"matrix\"", "id=\"figure3_arena\"", "id=\"figure4_pole\"",
          "id=\"speeds-arena\"", "the &lt;pole&gt;", "over the 2 fields", "3 with knowledge, 3 without"})
        EXPECT_THAT(page, HasSubstr(word));
    EXPECT_EQ(page.find("id=\"figure3\""), std::string::npos);
    EXPECT_EQ(page.find("{{"), std::string::npos);
    for (char const* name : {"figures/matrix.svg", "figures/matrix.png", "figures/figure3_arena.svg"})
        EXPECT_FALSE(made(name).empty()) << name;
    EXPECT_THAT(made("summary.json"), HasSubstr("\"transfer\""));
    EXPECT_THAT(made("summary.json"), HasSubstr("\"sources\""));

    std::filesystem::create_directories(scratch.file("kept"));
    for (auto const& entry : std::filesystem::directory_iterator{scratch.file("c")})
        if (entry.path().extension() == ".csv")
            std::filesystem::copy_file(entry.path(), scratch.file("kept/" + entry.path().filename().string()));
    write("pole.toml", pole + "nowhere\"\n");
    write_report(plan(), directory("kept"), directory("again"));
    for (char const* name : {"report.html", "matrix.csv", "summary.json", "figures/matrix.svg"})
        EXPECT_EQ(made(name), made(name, "again")) << name;
}

TEST_F(MatrixReport, shows_a_pool_in_the_figures_of_its_task_alone) {
    write("pole.toml", "name = \"pole\"\n[world]\nlibrary = \"" + test::c_world("pendulum") + "\"\n");
    auto const pools = [&](std::string const& with) {
        return "title = \"Two worlds\"\nruns = 2\ngenerations = 20\n"
               "[[source]]\nname = \"arena\"\nconfig = \"source.toml\"\n"
               "[[target]]\nname = \"arena\"\nconfig = \"target.toml\"\n"
               "[[target]]\nname = \"pole\"\nconfig = \"pole.toml\"\n"
               "[transfer]\nmethod = \"shaping\"\n[report]\nfigure3 = [\"both\", \"pole_from_none\"]\n"
               "[[pool]]\nname = \"both\"\nlabel = \"all in the arena\"\ntreatments = [\"arena_from_none\", \"" +
               with + "\"]\n";
    };
    write("campaign.toml", pools("arena_from_arena"));
    ASSERT_EQ(run_campaign(plan(), directory(), options()), ExitCode::done);
    write_report(plan(), directory());
    EXPECT_THAT(made("figures/figure3_arena.svg"), HasSubstr("all in the arena (n = 4)"));
    EXPECT_EQ(made("figures/figure3_pole.svg").find("all in the arena"), std::string::npos);
    EXPECT_THAT(made("figures/figure3_pole.svg"), HasSubstr("(n = 2)"));
    write("campaign.toml", pools("pole_from_none"));
    EXPECT_THAT(test::complaint_of<UsageError>([&] { plan(); }), HasSubstr("treatments of several target tasks"));
}
