#include <lore/core/csv.h>

#include <lore/core/error.h>
#include <lore/core/input_file.h>

#include <algorithm>

#include <fmt/format.h>

namespace lore {

namespace {

std::string_view trimmed(std::string_view field) {
    while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
    while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
    return field;
}

/// Of the part between quotes, and the spaces before it, at the start of the text [bytes]; 0 if it does not start so.
std::size_t quoted_length(std::string_view text) {
    std::size_t const start = text.find_first_not_of(' ');
    if (start == std::string_view::npos || text[start] != '"') return 0;
    for (std::size_t at = start + 1; (at = text.find('"', at)) != std::string_view::npos; at += 2)
        if (at + 1 == text.size() || text[at + 1] != '"') return at + 1;
    return 0;   // it has no end, and is text
}

/// A field without its quotes. What lies between them gets shorter in place.
std::string_view unquoted(std::string_view field, std::string& text) {
    if (field.size() < 2 || quoted_length(field) != field.size()) return field;
    char* const begin = text.data() + (field.data() - text.data()) + 1;
    char* end = begin;
    for (std::size_t i = 1; i + 1 < field.size(); ++i) {
        *end++ = field[i];
        if (field[i] == '"') ++i;
    }
    return {begin, static_cast<std::size_t>(end - begin)};
}

Error error_of(std::string const& path, std::string_view reason, std::string_view remedy) {
    return Error(fmt::format("cannot read {}", path), reason, remedy);
}

/// Calls header(field) for each field of the header, field(field) for those of the rows, row(line number) after each.
template <class Header, class Field, class Row>
void read_lines(std::string const& path, std::string_view text, std::string_view remedy, Header const& header,
                Field const& field, Row const& row) {
    std::size_t columns = 0;
    for (int number = 1; !text.empty(); ++number) {
        std::size_t const end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        CsvFields fields{line};
        if (number == 1) {
            for (; auto const next = fields.next(); ++columns) header(trimmed(*next));
            continue;
        }
        if (trimmed(line).empty()) continue;
        std::size_t count = 0;
        for (; auto const next = fields.next(); ++count) field(trimmed(*next));
        if (count != columns)
            throw error_of(path, fmt::format("line {} has {} fields, the header {}", number, count, columns), remedy);
        row(number);
    }
    if (columns == 0) throw error_of(path, "it is empty", remedy);
}

}   // namespace

std::optional<std::string_view> CsvFields::next() {
    if (ended_) return std::nullopt;
    std::size_t const comma = rest_.find(',', quoted_length(rest_));
    std::string_view const field = rest_.substr(0, comma);
    ended_ = comma == std::string_view::npos;
    if (!ended_) rest_.remove_prefix(comma + 1);
    return field;
}

CsvTable CsvTable::read(std::string const& path, std::string_view remedy) {
    return CsvTable{path, read_text(path, most_data), remedy};
}

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"") == std::string_view::npos && trimmed(text).size() == text.size())
        return std::string{text};
    std::string field{'"'};
    for (char const c : text) field.append(c == '"' ? 2 : 1, c);
    return field + '"';
}

CsvTable::CsvTable(std::string path, std::string text, std::string_view remedy)
    : path_(std::move(path)), remedy_(remedy) {
    if (constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; text.starts_with(byte_order_mark))
        text.erase(0, byte_order_mark.size());   // spreadsheets write one
    auto const kept = std::make_shared<std::string>(std::move(text));
    text_ = kept;
    read_lines(
        path_, *kept, remedy_, [&](std::string_view name) { names_.push_back(unquoted(name, *kept)); },
        [&](std::string_view field) { fields_.push_back(unquoted(field, *kept)); },
        [&](int number) { lines_.push_back(number); });
}

bool CsvTable::has(std::string_view name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t CsvTable::column(std::string_view name) const {
    auto const found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) {
        std::string const meant = nearest_word(name, names_.data(), names_.size());
        refuse(fmt::format("the header has no column '{}'{}", name,
                           meant.empty() ? "" : fmt::format(", only '{}'", meant)));
    }
    if (std::find(found + 1, names_.end(), name) != names_.end())
        refuse(fmt::format("two columns are called '{}'", name));
    return static_cast<std::size_t>(found - names_.begin());
}

void CsvTable::refuse(std::string_view reason) const { throw error_of(path_, reason, remedy_); }

void CsvTable::refuse(std::size_t row, std::size_t column, std::string_view reason) const {
    throw Error(fmt::format("cannot read {}, line {}, column {}", path_, lines_[row], names_[column]), reason, remedy_);
}

void CsvTable::refuse_field(std::size_t row, std::size_t column, std::string_view kind) const {
    refuse(row, column, fmt::format("'{}' is no {}", text(row, column).substr(0, 30), kind));
}

void CsvTable::refuse_range(std::size_t row, std::size_t column, std::string_view least, std::string_view most) const {
    refuse(row, column, fmt::format("{} is outside {} .. {}", text(row, column).substr(0, 30), least, most));
}

std::size_t count_csv_rows(std::string const& path, std::string_view text, std::string_view remedy) {
    std::size_t rows = 0;
    auto const nothing = [](std::string_view) {};
    read_lines(path, text, remedy, nothing, nothing, [&](int) { ++rows; });
    return rows;
}

}   // namespace lore
