#pragma once

#include <map>

#include <csignal>

namespace lore {

/// Counts requests to stop (INT, TERM, HUP unless nohup has turned it off, USR1, USR2), as long as it lives; then
/// signals are as they were before.
///
/// Signals are let in only during sleep(), which they and the end of a child cut short, so that none is missed between
/// a look at the state and the sleep. One at a time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(StopSignals const&) = delete;
    StopSignals& operator=(StopSignals const&) = delete;

    int requests() const;
    void sleep(double seconds) const;

private:
    std::map<int, struct sigaction> former_;
    sigset_t former_mask_{};
};

}   // namespace lore
