#include <lore/experiment/progress_file.h>

#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gtest/gtest.h>

#include <filesystem>

#include <sys/stat.h>

using namespace lore;

namespace {

GenerationSummary row_at(int generation) {
    GenerationSummary row;
    row.generation = generation;
    row.best_reward = generation / 3;
    row.mean_reward = generation / 7.0;
    row.distance = static_cast<DistanceKind>(generation % distance_kinds);
    row.mean_diversity = 1.0 / (generation + 1);
    row.evaluations = static_cast<std::uint64_t>(generation) * 200;
    row.steps = row.evaluations * 4000;
    row.seconds = 0.125 * generation;
    return row;
}

}   // namespace

TEST(ProgressFile, has_the_columns_that_scripts_rely_on) {
    EXPECT_EQ(progress_header("balls"), "generation,best_balls,mean_balls,distance,mean_diversity,best_shaping,mean_"
                                        "connections,mean_hidden,fronts,tied,"
                                        "shaping_at_max,evaluations,steps,seconds");
    EXPECT_EQ(text(row_at(2)), "2,0,0.2857142857142857,trajectory,0.3333333333333333,-1,0,0,0,0,0,400,1600000,0.250");
}

TEST(ProgressFile, gives_back_its_rows_and_leaves_out_a_half_written_last_one) {
    Scratch const scratch;
    std::vector<GenerationSummary> expected;
    {
        ProgressWriter writer{scratch.file("p.csv"), 0, "balls"};
        for (int generation = 0; generation < 20; ++generation) {
            expected.push_back(row_at(generation));
            writer.add(expected.back());
        }
        EXPECT_EQ(writer.sync(), std::filesystem::file_size(scratch.file("p.csv")));
    }
    EXPECT_EQ(read_progress(scratch.file("p.csv")), expected);
    std::filesystem::resize_file(scratch.file("p.csv"), std::filesystem::file_size(scratch.file("p.csv")) - 3);
    expected.pop_back();
    EXPECT_EQ(read_progress(scratch.file("p.csv")), expected);
}

TEST(ProgressFile, is_cut_back_so_that_no_row_appears_twice) {
    Scratch const scratch;
    std::uint64_t known = 0;
    {
        ProgressWriter writer{scratch.file("p.csv"), 0, "balls"};
        writer.add(row_at(0));
        known = writer.sync();
        writer.add(row_at(1));
        writer.add(row_at(2));
    }
    ProgressWriter writer{scratch.file("p.csv"), known, "balls"};
    writer.add(row_at(1));
    EXPECT_EQ(read_progress(scratch.file("p.csv")), (std::vector{row_at(0), row_at(1)}));
    EXPECT_THROW(ProgressWriter(scratch.file("p.csv"), 100000, "balls"), Error);
    EXPECT_THROW(ProgressWriter(scratch.file("gone/p.csv"), 0, "balls"), Error);
}

TEST(ProgressFile, that_is_damaged_is_refused) {
    Scratch const scratch;
    std::string const header = progress_header("balls") + "\n";
    for (std::string const& bad : {std::string{}, std::string{"a,b\n"}, header + "x\n", header + text(row_at(1)) + "\n",
                                   header + text(row_at(0)) + ",1\n", header + "0,0,0,cosine,0,0,0,0,0,0,0,0,0,0\n",
                                   header + "0,0,nan,adhoc,0,0,0,0,0,0,0,0,0,0\n"}) {
        write_file_atomically(scratch.file("p.csv"), std::string_view{bad});
        EXPECT_THROW(read_progress(scratch.file("p.csv")), Error) << bad;
    }
}

TEST(ProgressFile, goes_on_with_the_columns_it_has) {
    Scratch const scratch;
    std::string const moved = "seconds," + progress_header("balls").substr(0, progress_header("balls").rfind(','));
    std::string const first = "1.500,0,3,0.5,adhoc,0,-1,36,0,2,0,0,400,1600\n";
    write_file_atomically(scratch.file("p.csv"), std::string_view{moved + "\n" + first});
    {
        ProgressWriter writer{scratch.file("p.csv"), std::filesystem::file_size(scratch.file("p.csv")), "balls"};
        writer.add(row_at(1));
    }
    auto const rows = read_progress(scratch.file("p.csv"));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].seconds, 1.5);
    EXPECT_EQ(rows[0].best_reward, 3);
    EXPECT_EQ(rows[1], row_at(1));
}

TEST(ProgressFile, of_other_columns_is_not_gone_on_with) {
    Scratch const scratch;
    write_file_atomically(scratch.file("p.csv"), std::string_view{"a,b\n1,2\n"});
    EXPECT_THROW(ProgressWriter(scratch.file("p.csv"), 8, "balls"), Error);
}

TEST(ProgressFile, shows_its_last_whole_row_however_long_it_is) {
    Scratch const scratch;
    EXPECT_FALSE(read_last_progress(scratch.file("p.csv")));
    ProgressWriter writer{scratch.file("p.csv"), 0, "balls"};
    EXPECT_FALSE(read_last_progress(scratch.file("p.csv")));
    for (int generation = 0; generation < 100; ++generation) {
        writer.add(row_at(generation));
        EXPECT_EQ(read_last_progress(scratch.file("p.csv")), row_at(generation));
    }
    std::filesystem::resize_file(scratch.file("p.csv"), writer.sync() - 1);
    EXPECT_EQ(read_last_progress(scratch.file("p.csv")), row_at(98));
}

TEST(ProgressFile, that_is_a_pipe_is_not_waited_for) {
    Scratch const scratch;
    ASSERT_EQ(::mkfifo(scratch.file("p.csv").c_str(), 0600), 0);
    EXPECT_FALSE(read_last_progress(scratch.file("p.csv")));
}

TEST(ProgressFile, names_its_reward_columns_by_the_unit_and_reads_both) {
    Scratch const scratch;
    {
        ProgressWriter writer{scratch.file("p.csv"), 0, "points"};
        GenerationSummary row;
        row.best_reward = -1.25;
        writer.add(row);
    }
    EXPECT_TRUE(progress_header("points").starts_with("generation,best_reward,mean_reward,distance,"));
    auto const rows = read_progress(scratch.file("p.csv"));
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].best_reward, -1.25);
}
