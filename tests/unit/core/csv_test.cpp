#include <lore/core/csv.h>

#include "support/complaint.h"

#include <lore/core/error.h>

#include <gtest/gtest.h>

using namespace lore;
using lore::test::complaint_of;

namespace {

CsvTable table(std::string text) { return CsvTable{"t.csv", std::move(text), "Mend it."}; }

std::vector<std::string> fields_of(std::string_view line) {
    std::vector<std::string> fields;
    for (CsvFields rest{line}; auto const field = rest.next();) fields.emplace_back(*field);
    return fields;
}

}   // namespace

TEST(CsvFields, are_what_stands_between_the_commas) {
    using Fields = std::vector<std::string>;
    EXPECT_EQ(fields_of("a, b,"), (Fields{"a", " b", ""}));
    EXPECT_EQ(fields_of(""), Fields{""});
    EXPECT_EQ(fields_of("a"), Fields{"a"});
}

TEST(CsvTable, gives_fields_by_row_and_column_without_spaces_empty_lines_and_carriage_returns) {
    CsvTable const read = table("name, count\r\n one , 1\r\n\n two,2");
    ASSERT_EQ(read.rows(), 2u);
    EXPECT_EQ(read.text(0, read.column("name")), "one");
    EXPECT_EQ(read.number<int>(1, read.column("count")), 2);
    EXPECT_TRUE(read.has("count"));
    EXPECT_FALSE(read.has("counts"));
}

TEST(CsvTable, names_file_line_and_column_of_what_is_wrong) {
    CsvTable const read = table("a,b\n1,2\n\n3,x\n");
    EXPECT_EQ(complaint_of([&] { read.number<int>(1, 1); }),
              "cannot read t.csv, line 4, column b ('x' is no whole number). "
              "Mend it.");
    EXPECT_EQ(complaint_of([&] { read.number(1, 0, 0.0, 2.0); }),
              "cannot read t.csv, line 4, column a (3 is outside 0 .. "
              "2). Mend it.");
    EXPECT_EQ(complaint_of([] { table("a,b\n1,2\n3\n"); }),
              "cannot read t.csv (line 3 has 1 fields, the header 2). Mend it.");
}

TEST(CsvRows, are_counted_by_the_rules_of_a_table) {
    EXPECT_EQ(count_csv_rows("t.csv", "a,b\n1,2\r\n\n3,4", ""), 2u);
    EXPECT_EQ(count_csv_rows("t.csv", "a,b\n", ""), 0u);
    EXPECT_EQ(complaint_of([] { count_csv_rows("t.csv", "a,b\n1\n", "Mend it."); }),
              "cannot read t.csv (line 2 has 1 fields, the header 2). Mend it.");
    EXPECT_EQ(complaint_of([] { count_csv_rows("t.csv", "", "Mend it."); }),
              "cannot read t.csv (it is empty). Mend it.");
}

TEST(CsvTable, refuses_what_is_no_table_and_columns_that_are_missing_or_there_twice) {
    EXPECT_NE(complaint_of([] { table(""); }), "");
    EXPECT_NE(complaint_of([] { table("a,a\n1,2\n").column("a"); }), "");
    EXPECT_EQ(complaint_of([] { table("seed,run\n").column("sead"); }), "cannot read t.csv (the header has no column "
                                                                        "'sead', only 'seed'). Mend it.");
    EXPECT_NE(complaint_of([] { CsvTable::read("/", "Mend it."); }), "") << "a directory";
    EXPECT_NE(complaint_of([] { CsvTable::read("/nowhere.csv", "Mend it."); }), "");
}

TEST(CsvTable, refuses_numbers_that_are_not_finite_or_do_not_fit) {
    CsvTable const read = table("a\nnan\ninf\n1e999\n-1\n1.5\n\"1\"\n");
    for (std::size_t row : {0u, 1u, 2u, 5u}) EXPECT_THROW(read.number<double>(row, 0), Error) << row;
    EXPECT_THROW(read.number<unsigned>(3, 0), Error);
    EXPECT_THROW(read.number<int>(4, 0), Error);
    EXPECT_EQ(read.number<double>(4, 0), 1.5);
}
