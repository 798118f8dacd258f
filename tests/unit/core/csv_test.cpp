#include <lore/core/csv.h>

#include "support/complaint.h"
#include "support/scratch.h"

#include <lore/core/error.h>

#include <gtest/gtest.h>

#include <fstream>

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

TEST(CsvTable, takes_the_byte_order_mark_of_a_spreadsheet) {
    EXPECT_TRUE(table("\xef\xbb\xbfname,unit\na,b\n").has("name"));
}

TEST(CsvTable, takes_fields_between_quotes) {
    CsvTable const read =
        table("\"name\",unit\n \"a, b\" ,\"\"\n\" 5\"\" x \",\"1\"\nx \"y\",\"open\n\"a\"b,\"\"\"\"\n");
    ASSERT_EQ(read.rows(), 4u);
    std::size_t const name = read.column("name"), unit = read.column("unit");
    EXPECT_EQ(read.text(0, name), "a, b");
    EXPECT_EQ(read.text(0, unit), "");
    EXPECT_EQ(read.text(1, name), " 5\" x ");
    EXPECT_EQ(read.number<int>(1, unit), 1);
    EXPECT_EQ(read.text(2, name), "x \"y\"") << "quotes within a field are text";
    EXPECT_EQ(read.text(2, unit), "\"open");
    EXPECT_EQ(read.text(3, name), "\"a\"b");
    EXPECT_EQ(read.text(3, unit), "\"");
}

TEST(CsvTable, gives_back_any_text_that_was_written_as_a_field) {
    for (std::string const text : {"", "balls", "m/s", "a,b", "\"", "5\" pipes", " x ", "\",\"", "\"\"", ",", "x\""})
        EXPECT_EQ(table("a,b\n" + csv_field(text) + ",1\n").text(0, 0), text) << csv_field(text);
    EXPECT_EQ(csv_field("m/s"), "m/s");
    EXPECT_EQ(csv_field("5\" x, y"), "\"5\"\" x, y\"");
}

TEST(CsvTable, of_a_long_life_is_read) {
    Scratch const scratch;
    std::ofstream{scratch.file("t.csv")} << "a\n" << std::string(std::size_t{17} << 20, '\n') << "1\n";
    EXPECT_EQ(CsvTable::read(scratch.file("t.csv"), "Mend it.").rows(), 1u);
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
    CsvTable const read = table("a\nnan\ninf\n1e999\n-1\n1.5\n\"1\n");
    for (std::size_t row : {0u, 1u, 2u, 5u}) EXPECT_THROW(read.number<double>(row, 0), Error) << row;
    EXPECT_THROW(read.number<unsigned>(3, 0), Error);
    EXPECT_THROW(read.number<int>(4, 0), Error);
    EXPECT_EQ(read.number<double>(4, 0), 1.5);
}
