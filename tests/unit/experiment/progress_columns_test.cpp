#include "progress_columns.h"

#include <gtest/gtest.h>

using namespace lore;

namespace {

/// The columns of a later version: one more.
std::vector<ProgressColumn> later_columns() {
    auto const now = progress_columns();
    std::vector<ProgressColumn> later{now.begin(), now.end()};
    later.push_back({"novelty", "", [](GenerationSummary const& row) { return std::to_string(row.tied); },
                     [](std::string_view field, GenerationSummary& row) {
                         row.tied = static_cast<int>(field.size());
                         return true;
                     }});
    return later;
}

GenerationSummary some_row() {
    GenerationSummary row;
    row.generation = 3;
    row.mean_reward = 0.1;
    row.distance = DistanceKind::entropy;
    row.steps = 12000;
    row.seconds = 0.25;
    return row;
}

}   // namespace

TEST(ProgressColumns, each_give_back_what_they_print) {
    FileColumns const columns = all_columns();
    auto const back = row_from(columns, row_text(columns, some_row()));
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, some_row());
    EXPECT_FALSE(row_from(columns, row_text(columns, some_row()) + ",1"));
    EXPECT_FALSE(row_from(columns, "3"));
    EXPECT_FALSE(row_from(columns, ""));
}

TEST(ProgressColumns, are_found_by_name_in_any_order) {
    std::string header = header_of(all_columns(), "balls");
    header = header.substr(header.find(',') + 1) + ",generation";
    auto const columns = columns_named(header);
    ASSERT_TRUE(columns);
    EXPECT_EQ(header_of(*columns, "balls"), header);
    EXPECT_EQ(row_from(*columns, row_text(*columns, some_row())), some_row());
}

TEST(ProgressColumns, of_a_file_from_before_one_was_added_are_read_without_it) {
    auto const later = later_columns();
    auto const old = columns_named(header_of(all_columns(), "balls"), later);
    ASSERT_TRUE(old);
    EXPECT_EQ(row_from(*old, row_text(all_columns(), some_row())), some_row());
    EXPECT_EQ(row_text(*old, some_row()), row_text(all_columns(), some_row())) << "and the file keeps its columns";

    std::string const newer = header_of(all_columns(), "balls") + ",novelty";
    EXPECT_TRUE(columns_named(newer, later));
    EXPECT_FALSE(columns_named(newer)) << "an older Lore refuses what it does not know";
}

TEST(ProgressColumns, that_are_missing_or_named_twice_are_refused) {
    std::string const header = header_of(all_columns(), "balls");
    EXPECT_FALSE(columns_named(""));
    EXPECT_FALSE(columns_named(header.substr(0, header.rfind(','))));
    EXPECT_FALSE(columns_named(header + ",seconds"));
    EXPECT_FALSE(columns_named(header + ","));
    EXPECT_EQ(progress_columns().size(), columns_of_every_file) << "a later column may be missing: test it as above";
}
