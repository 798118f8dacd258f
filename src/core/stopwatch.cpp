#include <lore/core/stopwatch.h>

#include <sys/resource.h>

namespace lore {

double processor_seconds() {
    double total = 0;
    for (auto const who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        if (::getrusage(who, &used) != 0) continue;
        for (timeval const time : {used.ru_utime, used.ru_stime})
            total += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
    return total;
}

}   // namespace lore
