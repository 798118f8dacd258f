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

/// Appends the line's fields; returns how many.
std::size_t split(std::string_view line, std::vector<std::string_view>& fields) {
    std::size_t const before = fields.size();
    for (CsvFields of_line{line}; auto const field = of_line.next();) fields.push_back(trimmed(*field));
    return fields.size() - before;
}

}   // namespace

std::optional<std::string_view> CsvFields::next() {
    if (ended_) return std::nullopt;
    std::size_t const comma = rest_.find(',');
    std::string_view const field = rest_.substr(0, comma);
    ended_ = comma == std::string_view::npos;
    if (!ended_) rest_.remove_prefix(comma + 1);
    return field;
}

CsvTable CsvTable::read(std::string const& path, std::string_view remedy) {
    return CsvTable{path, read_text(path), remedy};
}

CsvTable::CsvTable(std::string path, std::string text, std::string_view remedy)
    : path_(std::move(path)), remedy_(remedy), text_(std::make_shared<std::string const>(std::move(text))) {
    std::string_view rest = *text_;
    for (int number = 1; !rest.empty(); ++number) {
        std::size_t const end = std::min(rest.find('\n'), rest.size());
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        if (names_.empty()) {
            split(line, names_);
            continue;
        }
        if (trimmed(line).empty()) continue;
        std::size_t const count = split(line, fields_);
        if (count != names_.size())
            refuse(fmt::format("line {} has {} fields, the header {}", number, count, names_.size()));
        lines_.push_back(number);
    }
    if (names_.empty()) refuse("it is empty");
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

void CsvTable::refuse(std::string_view reason) const {
    throw Error(fmt::format("cannot read {}", path_), reason, remedy_);
}

void CsvTable::refuse(std::size_t row, std::size_t column, std::string_view reason) const {
    throw Error(fmt::format("cannot read {}, line {}, column {}", path_, lines_[row], names_[column]), reason, remedy_);
}

void CsvTable::refuse_field(std::size_t row, std::size_t column, std::string_view kind) const {
    refuse(row, column, fmt::format("'{}' is no {}", text(row, column).substr(0, 30), kind));
}

void CsvTable::refuse_range(std::size_t row, std::size_t column, std::string_view least, std::string_view most) const {
    refuse(row, column, fmt::format("{} is outside {} .. {}", text(row, column).substr(0, 30), least, most));
}

}   // namespace lore
