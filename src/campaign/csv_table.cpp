#include "csv_table.h"

#include <lore/core/error.h>

#include <charconv>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

namespace lore {

namespace {

std::vector<std::string> fields_of(std::string_view line) {
    std::vector<std::string> fields;
    while (true) {
        std::size_t const comma = line.find(',');
        fields.emplace_back(line.substr(0, comma));
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

template <class Number>
bool parse(std::string const& text, Number& value) {
    auto const [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failed == std::errc{} && end == text.data() + text.size();
}

}   // namespace

CsvTable CsvTable::read(std::string const& path) {
    std::ifstream file{path};
    CsvTable table;
    table.path_ = path;
    std::string line;
    if (!file || !std::getline(file, line))
        throw Error(fmt::format("cannot read {}", path), "no such file, not readable, or empty",
                    "Make it again from the runs.");
    auto const without_return = [](std::string& text) {
        if (!text.empty() && text.back() == '\r') text.pop_back();
    };
    without_return(line);
    table.header_ = fields_of(line);
    for (int number = 2; std::getline(file, line); ++number) {
        without_return(line);
        if (line.empty()) continue;
        table.rows_.push_back(fields_of(line));
        if (table.rows_.back().size() != table.header_.size())
            throw Error(fmt::format("cannot read {}", path),
                        fmt::format("line {} has {} fields, the header {}", number, table.rows_.back().size(),
                                    table.header_.size()),
                        "Make it again from the runs.");
    }
    return table;
}

std::size_t CsvTable::column(std::string_view name) const {
    for (std::size_t c = 0; c < header_.size(); ++c)
        if (header_[c] == name) return c;
    throw Error(fmt::format("cannot read {}", path_), fmt::format("it has no column '{}'", name),
                "Make it again from the runs.");
}

void CsvTable::fail(std::size_t row, std::size_t column, std::string_view expected) const {
    throw Error(
        fmt::format("{}, line {}: {} is '{}'", path_, row + 2, header_[column], rows_[row][column].substr(0, 40)),
        fmt::format("{} is expected", expected), "Make it again from the runs.");
}

double CsvTable::number(std::size_t row, std::size_t column) const {
    double value = 0;
    if (!parse(text(row, column), value) || !std::isfinite(value)) fail(row, column, "a number");
    return value;
}

int CsvTable::integer(std::size_t row, std::size_t column) const {
    int value = 0;
    if (!parse(text(row, column), value)) fail(row, column, "a whole number");
    return value;
}

std::uint64_t CsvTable::natural(std::size_t row, std::size_t column) const {
    std::uint64_t value = 0;
    if (!parse(text(row, column), value)) fail(row, column, "a natural number");
    return value;
}

}   // namespace lore
