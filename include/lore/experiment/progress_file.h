#pragma once

#include <lore/evolution/evolution.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// One generation in progress.csv; the columns in this order.
struct ProgressRow {
    int generation = 0;
    int best_balls = 0;   ///< of the population after selection
    double mean_balls = 0;
    DistanceKind distance = DistanceKind::adhoc;
    double mean_diversity = 0;   ///< BD over the survivors
    double best_shaping = no_feature_value;
    double mean_connections = 0;
    double mean_hidden = 0;          ///< hidden neurons
    int fronts = 0;                  ///< of the joint ranking
    int tied = 0;                    ///< survivors that share all objectives with another
    double shaping_at_max = 0;       ///< share of the population that has best_shaping; 0 without a knowledge base
    std::uint64_t evaluations = 0;   ///< of the whole run up to here
    std::uint64_t steps = 0;         ///< simulated, likewise
    double seconds = 0;              ///< of wall time spent on this run, all sessions together
    friend bool operator==(ProgressRow const&, ProgressRow const&) = default;
};

std::string progress_header();
std::string text(ProgressRow const&);

/// Throws Error: missing, another header, a damaged row. A last line without its end (a killed run) is left out.
std::vector<ProgressRow> read_progress(std::string const& path);

/// What a generation's report says; evaluations and steps are those of the generation alone, seconds 0.
ProgressRow row_of(GenerationReport const&);

/// Appends rows to progress.csv, each at once, so that others can follow.
class ProgressWriter {
public:
    /// A new file with its header, or an old one cut back to `bytes` (not 0). Throws Error, also if it is shorter.
    ProgressWriter(std::string path, std::uint64_t bytes);
    ~ProgressWriter();
    ProgressWriter(ProgressWriter const&) = delete;
    ProgressWriter& operator=(ProgressWriter const&) = delete;
    void add(ProgressRow const&);
    /// Makes the rows so far durable; returns the file's length.
    std::uint64_t sync();

private:
    void write(std::string_view line);
    std::string path_;
    int file_ = -1;
    std::uint64_t bytes_ = 0;
};

}   // namespace lore
