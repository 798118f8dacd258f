#include "html.h"
#include "report_assets.h"

#include <gtest/gtest.h>

using namespace lore;

TEST(Filled, takes_the_whole_line_of_a_place_that_stands_alone) {
    EXPECT_EQ(filled("bases", {{"noun", "reward"}, {"bases", ""}}).find("\n\n"), std::string::npos);
    std::string const section = filled("bases", {{"noun", "reward"}, {"bases", "<table>\n</table>\n"}});
    EXPECT_NE(section.find("</h2>\n<table>\n</table>\n<p "), std::string::npos) << section;
}

TEST(Filled, puts_text_in_as_it_is_with_places_and_blocks_in_it) {
    EXPECT_EQ(filled("missing", {{"what", "{{what}} <!-- block page -->"}}),
              "<p class=\"warning\">{{what}} <!-- block page --></p>\n");
}

TEST(HtmlTable, shows_text_and_sorts_by_values) {
    struct Row {
        std::string name;
        double p;
    };
    std::vector<HtmlColumn<Row>> const columns{{"name", [](Row const& r) { return r.name; }, true},
                                               {"p", [](Row const& r) {
                                                    return HtmlCell{"<1", std::to_string(r.p)};
                                                }}};
    std::string const html = html_table("t", columns, std::vector<Row>{{"a & b", 0.5}});
    EXPECT_NE(html.find("<td class=\"text\">a &amp; b</td><td data-value=\"0.500000\">&lt;1</td>"), std::string::npos)
        << html;
}

TEST(HtmlTable, puts_a_second_line_into_a_cell_and_columns_closer_where_it_is_told) {
    std::vector<HtmlColumn<int>> const columns{{"n", [](int n) {
                                                    return HtmlCell{std::to_string(n), "7", "0 .. <9"};
                                                }}};
    std::string const narrow = html_table("t", columns, std::vector<int>{5});
    EXPECT_NE(narrow.find("<td data-value=\"7\">5<br><small>0 .. &lt;9</small></td>"), std::string::npos) << narrow;
    EXPECT_NE(narrow.find("class=\"sortable\""), std::string::npos);
    EXPECT_NE(html_table("t", columns, std::vector<int>{5}, Spacing::dense).find("class=\"sortable dense\""),
              std::string::npos);
}
