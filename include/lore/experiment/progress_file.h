#pragma once

#include <lore/core/file.h>
#include <lore/evolution/summary.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

struct ProgressColumn;

/// The first line of progress.csv, and the row of a generation; evaluations and steps are those of the whole run up to
/// it. Both without the end of the line. Of a reward in balls the columns are best_balls and mean_balls, of any other
/// best_reward and mean_reward.
std::string progress_header(std::string_view reward_unit);
std::string text(GenerationSummary const&);

/// All rows, by generation from 0. Columns are found by name, and a file from before a column was added is read
/// without it. Throws Error: missing, another header, a damaged row. A last line without its end (a killed run) is
/// left out.
std::vector<GenerationSummary> read_progress(std::string const& path);

/// The last whole row, found without reading all of the file; nothing if there is none, or none that can be read.
std::optional<GenerationSummary> read_last_progress(std::string const& path);

/// Appends rows to progress.csv, each at once, so that others can follow.
class ProgressWriter {
public:
    /// A new file with its header, or an old one cut back to `bytes` (not 0), which keeps the columns it has.
    /// Throws Error, also if the old one is shorter, or its header is not one of progress.csv.
    ProgressWriter(std::string path, std::uint64_t bytes, std::string_view reward_unit);
    void add(GenerationSummary const&);
    /// Makes the rows so far durable; returns the file's length.
    std::uint64_t sync();

private:
    void write(std::string_view line);
    std::string path_;
    std::vector<ProgressColumn const*> columns_;
    FileDescriptor file_;
    std::uint64_t bytes_ = 0;
};

}   // namespace lore
