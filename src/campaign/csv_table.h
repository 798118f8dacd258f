#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// A CSV file with a header and plain fields (no quotes: names and numbers are all we write), read strictly.
class CsvTable {
public:
    /// Throws Error: missing, empty, or a row of another length than the header.
    static CsvTable read(std::string const& path);

    std::size_t rows() const { return rows_.size(); }
    /// Throws Error if there is no such column.
    std::size_t column(std::string_view name) const;
    std::string const& text(std::size_t row, std::size_t column) const { return rows_[row][column]; }
    /// These throw Error, naming the line, for what is no finite number or no whole number of the type's range.
    double number(std::size_t row, std::size_t column) const;
    int integer(std::size_t row, std::size_t column) const;
    std::uint64_t natural(std::size_t row, std::size_t column) const;

private:
    [[noreturn]] void fail(std::size_t row, std::size_t column, std::string_view expected) const;
    std::string path_;
    std::vector<std::string> header_;
    std::vector<std::vector<std::string>> rows_;
};

}   // namespace lore
