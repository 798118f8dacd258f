#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lore {

/// The fields of one line of CSV, one after the other, as they stand between the commas, with the quotes of those that
/// have some. A view: valid as long as the line.
class CsvFields {
public:
    explicit CsvFields(std::string_view line) : rest_(line) {}
    /// The next one; nothing after the last. An empty line has one empty field.
    std::optional<std::string_view> next();

private:
    std::string_view rest_;
    bool ended_ = false;
};

/// The text as a field of CSV: between quotes as RFC 4180 has them if it has commas, quotes or outer spaces, else as it
/// is. Precondition: it has no line end.
std::string csv_field(std::string_view text);

/// A CSV text with a header, read strictly. Fields may stand between quotes (RFC 4180), but have no line ends.
///
/// Spaces around a field and a carriage return at a line's end do not count, nor do empty lines. Whatever is wrong
/// throws Error, which names the file, with line and column where there is one, and ends with `remedy`.
class CsvTable {
public:
    /// Throws Error: no such file, not readable, longer than most_data.
    static CsvTable read(std::string const& path, std::string_view remedy);
    /// `path` is what errors call the text. Throws Error: no header, or a row of another length than the header.
    CsvTable(std::string path, std::string text, std::string_view remedy);

    std::size_t rows() const { return lines_.size(); }
    bool has(std::string_view name) const;
    /// Throws Error if no column has this name, or two have.
    std::size_t column(std::string_view name) const;
    std::string_view text(std::size_t row, std::size_t column) const { return fields_[row * names_.size() + column]; }
    /// Throws Error for what is no finite number, no whole number where Number is integral, or outside the bounds.
    template <class Number>
    Number number(std::size_t row, std::size_t column, Number least = std::numeric_limits<Number>::lowest(),
                  Number most = std::numeric_limits<Number>::max()) const {
        std::string_view const field = text(row, column);
        Number value{};
        auto const [end, failed] = std::from_chars(field.data(), field.data() + field.size(), value);
        bool finite = true;
        if constexpr (std::is_floating_point_v<Number>) finite = std::isfinite(value);
        if (failed != std::errc{} || end != field.data() + field.size() || !finite)
            refuse_field(row, column, std::is_integral_v<Number> ? "whole number" : "number");
        if (value < least || value > most) refuse_range(row, column, shortest(least), shortest(most));
        return value;
    }

    [[noreturn]] void refuse(std::string_view reason) const;
    [[noreturn]] void refuse(std::size_t row, std::size_t column, std::string_view reason) const;

private:
    [[noreturn]] void refuse_field(std::size_t row, std::size_t column, std::string_view kind) const;
    [[noreturn]] void refuse_range(std::size_t row, std::size_t column, std::string_view least,
                                   std::string_view most) const;
    template <class Number>
    static std::string shortest(Number value) {
        char digits[64];
        return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
    }

    std::string path_, remedy_;
    std::shared_ptr<std::string const> text_;   ///< what the views below look into
    std::vector<std::string_view> names_, fields_;
    std::vector<int> lines_;   ///< number of each row's line, from 1
};

/// How many rows such a text has. Throws Error as CsvTable does, but keeps no field: for tables of any size.
std::size_t count_csv_rows(std::string const& path, std::string_view text, std::string_view remedy);

}   // namespace lore
