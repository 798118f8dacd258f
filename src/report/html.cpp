#include "html.h"

#include "report_assets.h"

#include <cassert>

#include <fmt/format.h>

namespace lore {

namespace {

/// The lines between "<!-- block NAME -->" and the next such line, or the end.
std::string_view block_named(std::string_view name) {
    std::string const mark = fmt::format("<!-- block {} -->\n", name);
    std::size_t const at = report_html.find(mark);
    assert(at != std::string_view::npos);
    std::string_view const block = report_html.substr(at + mark.size());
    return block.substr(0, block.find("<!-- block "));
}

}   // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for (char const c : text) {
        if (c == '<') out += "&lt;";
        else if (c == '>') out += "&gt;";
        else if (c == '&') out += "&amp;";
        else if (c == '"') out += "&quot;";
        else out += c;
    }
    return out;
}

std::string filled(std::string_view block, Places const& places) {
    std::string_view rest = block_named(block);
    std::string text;
    bool at_line_start = true;
    for (std::size_t at = rest.find("{{"); at != std::string_view::npos; at = rest.find("{{")) {
        std::size_t const end = rest.find("}}", at);
        assert(end != std::string_view::npos);
        auto const place = places.find(rest.substr(at + 2, end - at - 2));
        assert(place != places.end());
        text += rest.substr(0, at);
        text += place->second;
        if (at > 0) at_line_start = rest[at - 1] == '\n';
        rest.remove_prefix(end + 2);
        at_line_start = at_line_start && rest.starts_with('\n');
        if (at_line_start) rest.remove_prefix(1);
    }
    return text += rest;
}

std::string html_heading(std::string_view text, bool is_text) {
    return fmt::format("<th scope=\"col\"{}><button type=\"button\">{}</button></th>", is_text ? " class=\"text\"" : "",
                       escaped(text));
}

std::string html_cell(HtmlCell const& cell, bool is_text) {
    std::string const value = cell.sorted_by.empty() ? "" : fmt::format(" data-value=\"{}\"", escaped(cell.sorted_by));
    std::string const below = cell.below.empty() ? "" : fmt::format("<br><small>{}</small>", escaped(cell.below));
    return fmt::format("<td{}{}>{}{}</td>", is_text ? " class=\"text\"" : "", value, escaped(cell.shown), below);
}

}   // namespace lore
