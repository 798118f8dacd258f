#include "stop_request.h"

#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <cstring>

#include <time.h>

namespace lore {

namespace {

constexpr int stop_signals[]{SIGUSR1, SIGUSR2, SIGTERM, SIGINT, SIGXCPU};
constexpr long long patience_ns = 500'000'000;

// Handlers may only touch these.
std::atomic<int> requested{0};
std::atomic<long long> requested_at{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<long long>::is_always_lock_free);

long long now_ns() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

extern "C" void on_stop_signal(int number) {
    if (requested.load() == 0) {
        requested_at = now_ns();
        requested = number;
    } else if (number != SIGXCPU && now_ns() - requested_at.load() >= patience_ns) {   // the kernel repeats XCPU
        std::signal(number, SIG_DFL);
        std::raise(number);   // delivered when this handler returns
    }
}

void set_action(int number, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    ::sigaction(number, &action, nullptr);
}

void turn_into_errors() {
    set_action(SIGXFSZ, SIG_IGN);
    set_action(SIGPIPE, SIG_IGN);
}

}   // namespace

void install_stop_handlers() {
    for (int const number : stop_signals) set_action(number, on_stop_signal);
    turn_into_errors();
}

void ignore_stop_signals() {
    for (int const number : stop_signals) set_action(number, SIG_IGN);
    turn_into_errors();
}

std::string stop_request() {
    int const number = requested.load();
    return number == 0 ? "" : fmt::format("signal {} ({})", number, ::strsignal(number));
}

}   // namespace lore
