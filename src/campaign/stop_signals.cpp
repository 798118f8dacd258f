#include <lore/campaign/stop_signals.h>

#include <atomic>
#include <cmath>

#include <poll.h>

namespace lore {

namespace {

std::atomic<int> stop_requests{0};
void request_stop(int) { stop_requests.fetch_add(1); }
void wake_up(int) {}

}   // namespace

StopSignals::StopSignals() {
    stop_requests = 0;
    sigset_t ours;
    sigemptyset(&ours);
    for (int const signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGCHLD}) {
        sigaddset(&ours, signal);
        struct sigaction action {};
        action.sa_handler = signal == SIGCHLD ? wake_up : request_stop;
        ::sigaction(signal, &action, &former_[signal]);
    }
    if (former_[SIGHUP].sa_handler == SIG_IGN) ::signal(SIGHUP, SIG_IGN);   // nohup
    ::sigprocmask(SIG_BLOCK, &ours, &former_mask_);
}

StopSignals::~StopSignals() {
    for (auto const& [signal, action] : former_) ::sigaction(signal, &action, nullptr);
    ::sigprocmask(SIG_SETMASK, &former_mask_, nullptr);
}

int StopSignals::requests() const { return stop_requests; }

void StopSignals::sleep(double seconds) const {
    double const whole = std::floor(seconds);
    timespec const time{static_cast<time_t>(whole), static_cast<long>((seconds - whole) * 1e9)};
    ::ppoll(nullptr, 0, &time, &former_mask_);
}

}   // namespace lore
