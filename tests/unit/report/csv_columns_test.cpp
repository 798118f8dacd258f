#include "csv_columns.h"

#include <lore/core/error.h>
#include <lore/statistics/bootstrap.h>

#include <gtest/gtest.h>

using namespace lore;

namespace {

struct Row {
    std::string name;
    int count = 0;
    double mean = 0;
    Interval band;
};

std::vector<CsvColumn<Row>> const columns{csv_column("name", &Row::name), csv_column("count", &Row::count),
                                          csv_column("mean", &Row::mean, rounded),
                                          csv_column_within(&Row::band, csv_column("high", &Interval::high))};

std::vector<Row> read(std::string text) { return csv_rows(columns, CsvTable{"t.csv", std::move(text), "Mend it."}); }

}   // namespace

TEST(CsvColumns, write_what_they_read) {
    std::string const text = "name,count,mean,high\na,1,0.5000,0.25\n\"b, c\",2,3.0000,7\n";
    EXPECT_EQ(csv_text(columns, read(text)), text);
}

TEST(CsvColumns, may_be_in_any_order_among_others) {
    auto const rows = read("mean,other,count,name,high\n1.5,x,3,c,2\n");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].name, "c");
    EXPECT_EQ(rows[0].count, 3);
    EXPECT_EQ(rows[0].band.high, 2);
    EXPECT_THROW(read("name,count,high\na,1,2\n"), Error) << "without a mean";
}
