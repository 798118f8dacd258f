#pragma once

#include <lore/core/csv.h>

#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lore {

/// One column of a table whose rows are Row: its name, and how a field is written and read.
template <class Row>
struct CsvColumn {
    std::string name;
    std::function<void(std::string&, Row const&)> write;
    std::function<void(CsvTable const&, std::size_t row, std::size_t column, Row&)> read;
};

enum class Digits : std::uint8_t { shortest, four };
inline constexpr Digits rounded = Digits::four;   ///< to 4 decimals

/// The column of a member: text (csv_field), a whole number, or a number in its shortest form or rounded.
template <class Row, class Value>
CsvColumn<Row> csv_column(std::string name, Value Row::*member, Digits digits = Digits::shortest) {
    return {std::move(name),
            [=](std::string& text, Row const& row) {
                if constexpr (std::is_same_v<Value, std::string>) {
                    text += csv_field(row.*member);
                    return;
                }
                if constexpr (std::is_floating_point_v<Value>)
                    if (digits == Digits::four) {
                        fmt::format_to(std::back_inserter(text), "{:.4f}", row.*member);
                        return;
                    }
                fmt::format_to(std::back_inserter(text), "{}", row.*member);
            },
            [=](CsvTable const& table, std::size_t r, std::size_t c, Row& row) {
                if constexpr (std::is_same_v<Value, std::string>) row.*member = std::string{table.text(r, c)};
                else row.*member = table.number<Value>(r, c);
            }};
}

/// The column of a part of the row.
template <class Row, class Part>
CsvColumn<Row> csv_column_within(Part Row::*part, CsvColumn<Part> column) {
    return {
        column.name, [=](std::string& text, Row const& row) { column.write(text, row.*part); },
        [=](CsvTable const& table, std::size_t r, std::size_t c, Row& row) { column.read(table, r, c, row.*part); }};
}

template <class Row>
std::string csv_text(std::vector<CsvColumn<Row>> const& columns, std::vector<Row> const& rows) {
    std::string text;
    auto const line = [&](auto const& field) {
        for (CsvColumn<Row> const& column : columns) {
            if (&column != columns.data()) text += ',';
            field(column);
        }
        text += '\n';
    };
    line([&](CsvColumn<Row> const& column) { text += column.name; });
    for (Row const& row : rows) line([&](CsvColumn<Row> const& column) { column.write(text, row); });
    return text;
}

template <class Row>
std::vector<Row> csv_rows(std::vector<CsvColumn<Row>> const& columns, CsvTable const& table) {
    std::vector<Row> rows(table.rows());
    for (CsvColumn<Row> const& column : columns) {
        std::size_t const c = table.column(column.name);
        for (std::size_t r = 0; r < rows.size(); ++r) column.read(table, r, c, rows[r]);
    }
    return rows;
}

}   // namespace lore
