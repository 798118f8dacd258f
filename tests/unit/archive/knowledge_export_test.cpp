#include <lore/archive/knowledge_export.h>

#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/npy_file.h>
#include <lore/collectball/collectball.h>
#include <lore/core/error.h>

#include <gmock/gmock.h>

#include <array>
#include <filesystem>

using namespace lore;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

/// Two features of two steps; binary channels of feature 1, step 0: ball_right (bit 0) and carrying (bit 8).
KnowledgeBase const two{{2, 1.83f, collectball_channels()},
                        {},
                        {{0, 0, 0x101, 0},
                         {0.5f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0.25f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.125f},
                         {3.5, 1},
                         {7, 1},
                         {2, 1}}};

KnowledgeConfig windows_of_robots(int length) { return {length, 1.83f, collectball_channels()}; }

}   // namespace

TEST(KnowledgeCsv, has_a_row_a_feature_with_the_channels_in_their_order) {
    std::string const csv = knowledge_csv(two);
    EXPECT_THAT(csv, HasSubstr("feature,value,reward_sum,count,range_right_0,range_left_0,"));
    EXPECT_THAT(csv, HasSubstr(",right_wheel_1,collect_1\n"));
    EXPECT_THAT(csv, HasSubstr("\n0,3.5,7,2,0.5,0,0,0,0,0,0,0,0,0,0,0,0,0,1,0,"));
    EXPECT_THAT(csv, HasSubstr("\n1,1,1,1,0.25,0,0,1,0,0,0,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0.125\n"));
}

TEST(KnowledgeCsv, ends_with_the_evidence_that_there_is) {
    KnowledgeArrays arrays{{0}, std::vector<float>(6), {2}, {4}, {2}};
    arrays.evidence.gammas = {0.5, 0.995};
    arrays.evidence.showings = {3};
    arrays.evidence.return_sums = {1.5, 2.25};
    arrays.evidence.has_credit = true;
    arrays.evidence.news = {1};
    arrays.evidence.gain_sums = {-2};
    arrays.evidence.success_reward = 2;
    arrays.evidence.successes = 5;
    arrays.evidence.failures = 9;
    arrays.evidence.successes_that_showed = {4};
    arrays.evidence.failures_that_showed = {3};
    KnowledgeBase const base{{1, 1.83f, collectball_channels()}, {}, std::move(arrays)};
    EXPECT_THAT(knowledge_csv(base), HasSubstr(",collect_0,showings,return_sum_0.5,return_sum_0.995,news,gain_sum,"
                                               "successes_that_showed,failures_that_showed\n"));
    EXPECT_THAT(knowledge_csv(base), HasSubstr(",0,3,1.5,2.25,1,-2,4,3\n"));
    Scratch const scratch;
    export_knowledge(scratch.file("kb"), base);
    EXPECT_THAT(read_npy(scratch.file("kb/return_sums.npy")).shape, ElementsAre(2, 1));
    EXPECT_THAT(read_npy(scratch.file("kb/showings.npy")).values, ElementsAre(3.0f));
    EXPECT_THAT(read_npy(scratch.file("kb/gain_sums.npy")).values, ElementsAre(-2.0f));
    EXPECT_THAT(read_npy(scratch.file("kb/contrast_totals.npy")).values, ElementsAre(5.0f, 9.0f));
    EXPECT_THAT(read_npy(scratch.file("kb/failures_that_showed.npy")).values, ElementsAre(3.0f));
    export_knowledge(scratch.file("kb"), two);   // into the same directory
    EXPECT_FALSE(std::filesystem::exists(scratch.file("kb/contrast_totals.npy")));
}

TEST(ExportKnowledge, writes_arrays_that_read_back_as_the_windows) {
    Scratch const scratch;
    export_knowledge(scratch.file("kb"), two);
    NpyArray const features = read_npy(scratch.file("kb/features.npy"));
    EXPECT_THAT(features.shape, ElementsAre(2, 2, 15));
    EXPECT_THAT(read_npy(scratch.file("kb/values.npy")).values, ElementsAre(3.5f, 1.0f));
    EXPECT_THAT(read_npy(scratch.file("kb/reward_sums.npy")).values, ElementsAre(7.0f, 1.0f));
    Trace const back = read_windows(scratch.file("kb/features.npy"), two.config());
    std::vector<Window> const windows = windows_of(back, 2);
    ASSERT_EQ(windows.size(), 2u);
    for (int i = 0; i < 2; ++i)
        EXPECT_EQ(squared_distance(collectball_channels(), windows[static_cast<std::size_t>(i)], two.window(i)), 0.0f);
}

TEST(KnowledgeCsv, has_columns_of_any_world_s_channels) {
    Channels const channels{{{"angle", false}, {"touch", true}}, {{"torque", false}}};
    KnowledgeBase const base{{2, 1.83f, channels}, {}, {{0, 1}, {0.5f, 0.25f, 0, 1}, {-1.5}, {-1.5}, {1}}};
    EXPECT_EQ(knowledge_csv(base), "feature,value,reward_sum,count,angle_0,touch_0,torque_0,angle_1,touch_1,torque_1\n"
                                   "0,-1.5,-1.5,1,0.5,0,0.25,0,1,1\n");
    Scratch const scratch;
    export_knowledge(scratch.file("kb"), base);
    EXPECT_THAT(read_npy(scratch.file("kb/features.npy")).shape, ElementsAre(1, 2, 3));
    Trace const back = read_windows(scratch.file("kb/features.npy"), base.config());
    EXPECT_EQ(back.steps(), 2);
    EXPECT_EQ(squared_distance(channels, windows_of(back, 2).at(0), base.window(0)), 0.0f);
}

TEST(ReadWindows, takes_windows_in_rows_too_and_refuses_other_shapes) {
    Scratch const scratch;
    std::string const path = scratch.file("w.npy");
    std::vector<float> values(60, 0.0f);
    write_npy(path, values, std::array<std::size_t, 2>{2, 30});
    EXPECT_EQ(read_windows(path, windows_of_robots(2)).steps(), 4);
    EXPECT_THROW(read_windows(path, windows_of_robots(4)), Error);
    write_npy(path, values, std::array<std::size_t, 2>{4, 15});
    EXPECT_THROW(read_windows(path, windows_of_robots(2)), Error);
    EXPECT_EQ(read_windows(path, windows_of_robots(1)).steps(), 4);
}

TEST(ReadWindows, refuses_a_binary_channel_that_is_neither_0_nor_1) {
    Scratch const scratch;
    std::string const path = scratch.file("w.npy");
    std::vector<float> values(30, 0.0f);
    values[15 + 9] = 0.5f;
    write_npy(path, values, std::array<std::size_t, 3>{1, 2, 15});
    try {
        read_windows(path, windows_of_robots(2));
        FAIL();
    } catch (Error const& error) { EXPECT_THAT(error.what(), HasSubstr("window 0, step 1: bumper_right is 0.5")); }
}
