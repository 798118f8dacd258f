#pragma once

#include <chrono>
#include <utility>

namespace lore {

/// Wall-clock seconds, for reports of where the time went; results never depend on it. Never jumps.
class Stopwatch {
public:
    /// Since the last lap, or the beginning.
    double lap() {
        auto const now = Clock::now();
        return std::chrono::duration<double>(now - std::exchange(lap_, now)).count();
    }
    /// Since the beginning.
    double total() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
    Clock::time_point lap_ = start_;
};

/// Processor time of this process since it began, and of its children that have ended, in user and kernel mode [s].
double processor_seconds();

}   // namespace lore
