#pragma once

#include <span>
#include <string>

namespace lore {

/// What a run has taken so far, and whether it is still to be finished.
struct RunPace {
    std::string group;   ///< its treatment: runs of one take about the same time
    int generation = 0, generations = 0;
    double seconds = 0;   ///< of wall time
    bool unfinished = true;
};

/// Seconds of work that are left in all unfinished runs together. A generation takes what the treatment's runs have
/// shown, else what any have; 0 if none has shown anything.
double work_left(std::span<RunPace const>);

}   // namespace lore
