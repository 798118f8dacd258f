#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// Text as HTML shows it.
std::string escaped(std::string_view text);

/// What fills a template's places, by name.
using Places = std::map<std::string, std::string, std::less<>>;

/// A block of page.html.in with its places {{name}} filled. A place alone on its line takes the whole line: its
/// text ends with a line's end, or is empty and leaves no line. Precondition: there is such a block, and all of its
/// places are given.
std::string filled(std::string_view block, Places const&);

/// What a table's cell shows, and what its column is sorted by where that differs.
struct HtmlCell {
    HtmlCell(std::string text, std::string value = "") : shown(std::move(text)), sorted_by(std::move(value)) {}
    HtmlCell(char const* text) : shown(text) {}
    HtmlCell(std::string text, std::string value, std::string second_line)
        : shown(std::move(text)), sorted_by(std::move(value)), below(std::move(second_line)) {}
    std::string shown, sorted_by;
    std::string below;   ///< in small letters under it, where a column of its own would make the table too wide
};

/// One column of a table whose rows are Row.
template <class Row>
struct HtmlColumn {
    std::string heading;
    std::function<HtmlCell(Row const&)> cell;
    bool is_text = false;   ///< to the left, not to the right as numbers are
};

std::string html_heading(std::string_view text, bool is_text);
std::string html_cell(HtmlCell const&, bool is_text);

/// `dense`: columns stand closer and labels may take several lines, so that a wide table fits the page.
enum class Spacing : std::uint8_t { usual, dense };

/// A table whose headings sort it.
template <class Row>
std::string html_table(std::string_view id, std::vector<HtmlColumn<Row>> const& columns, std::vector<Row> const& rows,
                       Spacing spacing = Spacing::usual) {
    std::string const dense = spacing == Spacing::dense ? " dense" : "";
    std::string html =
        "<div class=\"scroll\"><table class=\"sortable" + dense + "\" id=\"" + std::string{id} + "\"><thead><tr>";
    for (HtmlColumn<Row> const& column : columns) html += html_heading(column.heading, column.is_text);
    html += "</tr></thead><tbody>\n";
    for (Row const& row : rows) {
        html += "<tr>";
        for (HtmlColumn<Row> const& column : columns) html += html_cell(column.cell(row), column.is_text);
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

}   // namespace lore
