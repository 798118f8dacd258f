#pragma once

#include <lore/evolution/summary.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// One column of progress.csv, described once: header, rows and reading all follow from it.
struct ProgressColumn {
    std::string_view name;
    std::string_view other_name;   ///< where the reward is not in balls; empty: the same
    std::string (*text)(GenerationSummary const&);
    bool (*read)(std::string_view field, GenerationSummary&);   ///< false: the field is no such value
};

/// All columns, in the order of a new file.
std::span<ProgressColumn const> progress_columns();
/// The first so many are in every file; those of before a later column was added lack it, and its values keep their
/// defaults.
inline constexpr std::size_t columns_of_every_file = 14;

/// The columns of one file in its order.
using FileColumns = std::vector<ProgressColumn const*>;

/// What a header names; nothing if one is unknown or there twice, or one of the first `required` is missing.
std::optional<FileColumns> columns_named(std::string_view header,
                                         std::span<ProgressColumn const> known = progress_columns(),
                                         std::size_t required = columns_of_every_file);
FileColumns all_columns();

std::string header_of(FileColumns const&, std::string_view reward_unit);
/// Without the end of the line, as is what row_from takes.
std::string row_text(FileColumns const&, GenerationSummary const&);
/// Nothing if a field is not what it should be, or there are more or fewer of them than columns.
std::optional<GenerationSummary> row_from(FileColumns const&, std::string_view line);

}   // namespace lore
