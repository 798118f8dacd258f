#include "time_report.h"

#include <lore/core/progress.h>

#include <fmt/format.h>

namespace lore {

std::string time_report(std::vector<RankTimes> const& ranks, MasterTimes const& master) {
    double const wall = master.wall > 0 ? master.wall : 1e-9;
    std::string report =
        fmt::format("time: {} of wall clock, in percent of it:\n{:>6} {:>6} {:>10} {:>9} {:>9} {:>6} {:>7}\n",
                    duration_text(wall), "rank", "start", "evaluation", "distances", "selection", "files", "waiting");
    for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
        bool const is_master = rank == 0;
        report += fmt::format("{:>6} {:>6.1f} {:>10.1f} {:>9.1f} {:>9.1f} {:>6.1f} {:>7.1f}\n", rank,
                              is_master ? 100 * master.start / wall : 0.0, 100 * ranks[rank].evaluation / wall,
                              100 * ranks[rank].distances / wall, is_master ? 100 * master.selection / wall : 0.0,
                              is_master ? 100 * master.files / wall : 0.0, 100 * ranks[rank].waiting / wall);
    }
    return report;
}

}   // namespace lore
