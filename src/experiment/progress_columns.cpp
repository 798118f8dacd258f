#include "progress_columns.h"

#include <lore/core/csv.h>
#include <lore/core/error.h>
#include <lore/world/reward_text.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace lore {

namespace {

using Row = GenerationSummary;

template <class Number>
std::string text_of(Number number) {
    return fmt::format("{}", number);
}
std::string text_of(DistanceKind kind) { return std::string{name(kind)}; }

template <class Number>
bool take(std::string_view field, Number& number) {
    char const* const last = field.data() + field.size();
    auto const [end, error] = std::from_chars(field.data(), last, number);
    return error == std::errc{} && end == last && std::isfinite(static_cast<double>(number));   // "nan" is a number
}
bool take(std::string_view field, DistanceKind& kind) {
    try {
        kind = distance_kind(field);
        return true;
    } catch (UsageError const&) { return false; }
}

template <auto member>
bool read(std::string_view field, Row& row) {
    return take(field, row.*member);
}
template <auto member>
constexpr ProgressColumn column(std::string_view name, std::string_view other_name = "") {
    return {name, other_name, [](Row const& row) { return text_of(row.*member); }, read<member>};
}

/// In a period that the shaping value serves (ShapingUse::distance) the distance is measured, but no objective.
std::string serving(Row const& row) { return row.shaping_serves ? "shaping" : text_of(row.distance); }
bool read_serving(std::string_view field, Row& row) {
    row.shaping_serves = field == "shaping";
    return row.shaping_serves || take(field, row.distance);
}

std::string milliseconds(Row const& row) { return fmt::format("{:.3f}", row.seconds); }

/// docs/manual/formats.md says what they mean. A new column is a line at the end, so that scripts that count columns go
/// on.
constexpr ProgressColumn columns[]{
    column<&Row::generation>("generation"),
    column<&Row::best_reward>("best_balls", "best_reward"),
    column<&Row::mean_reward>("mean_balls", "mean_reward"),
    {"distance", "", serving, read_serving},
    column<&Row::mean_diversity>("mean_diversity"),
    column<&Row::best_shaping>("best_shaping"),
    column<&Row::mean_connections>("mean_connections"),
    column<&Row::mean_hidden>("mean_hidden"),
    column<&Row::fronts>("fronts"),
    column<&Row::tied>("tied"),
    column<&Row::shaping_at_max>("shaping_at_max"),
    column<&Row::evaluations>("evaluations"),
    column<&Row::steps>("steps"),
    {"seconds", "", milliseconds, read<&Row::seconds>},
};

}   // namespace

std::span<ProgressColumn const> progress_columns() { return columns; }

std::optional<FileColumns> columns_named(std::string_view header, std::span<ProgressColumn const> known,
                                         std::size_t required) {
    FileColumns named;
    CsvFields fields{header};
    while (auto const field = fields.next()) {
        auto const column = std::find_if(known.begin(), known.end(), [&](ProgressColumn const& one) {
            return one.name == *field || (!one.other_name.empty() && one.other_name == *field);
        });
        if (column == known.end() || std::find(named.begin(), named.end(), &*column) != named.end())
            return std::nullopt;
        named.push_back(&*column);
    }
    for (ProgressColumn const& column : known.first(required))
        if (std::find(named.begin(), named.end(), &column) == named.end()) return std::nullopt;
    return named;
}

FileColumns all_columns() {
    FileColumns all;
    for (ProgressColumn const& column : columns) all.push_back(&column);
    return all;
}

std::string header_of(FileColumns const& of_file, std::string_view reward_unit) {
    bool const other = reward_word(reward_unit) != first_reward_unit;
    std::string header;
    for (ProgressColumn const* column : of_file)
        header.append(header.empty() ? "" : ",")
            .append(other && !column->other_name.empty() ? column->other_name : column->name);
    return header;
}

std::string row_text(FileColumns const& of_file, GenerationSummary const& row) {
    std::string text;
    for (ProgressColumn const* column : of_file) text.append(text.empty() ? "" : ",").append(column->text(row));
    return text;
}

std::optional<GenerationSummary> row_from(FileColumns const& of_file, std::string_view line) {
    GenerationSummary row;
    CsvFields fields{line};
    for (ProgressColumn const* column : of_file) {
        auto const field = fields.next();
        if (!field || !column->read(*field, row)) return std::nullopt;
    }
    if (fields.next()) return std::nullopt;
    return row;
}

}   // namespace lore
