#include <lore/campaign/time_left.h>

#include <algorithm>
#include <map>

namespace lore {

namespace {

struct Shown {
    double seconds = 0, generations = 0;
    void add(RunPace const& run) {
        seconds += run.seconds;
        generations += run.generation;
    }
    bool anything() const { return generations > 0; }
};

}   // namespace

double work_left(std::span<RunPace const> runs) {
    Shown of_all;
    std::map<std::string, Shown> by_group;
    for (RunPace const& run : runs) {
        of_all.add(run);
        by_group[run.group].add(run);
    }
    double left = 0;
    for (RunPace const& run : runs) {
        Shown const& own = by_group[run.group];
        Shown const& shown = own.anything() ? own : of_all;
        if (!run.unfinished || !shown.anything()) continue;
        left += shown.seconds / shown.generations * std::max(0, run.generations - run.generation);
    }
    return left;
}

}   // namespace lore
