#include "foreign_call.h"

#include <lore/core/error.h>

#include <array>
#include <csignal>
#include <cstring>
#include <initializer_list>

#include <sys/time.h>
#include <unistd.h>

namespace lore {

namespace {

struct Watched {
    int signal;
    char const* name;
    struct sigaction before;
};
std::array<Watched, 5> watched{{{SIGSEGV, "SIGSEGV", {}},
                                {SIGBUS, "SIGBUS", {}},
                                {SIGFPE, "SIGFPE", {}},
                                {SIGILL, "SIGILL", {}},
                                {SIGABRT, "SIGABRT", {}}}};

int volatile patience = 0;   ///< for one call [s]

/// Only calls that a signal handler may make.
void say(std::initializer_list<char const*> words) {
    for (char const* const word : words) {
        [[maybe_unused]] auto const ignored = ::write(STDERR_FILENO, word, std::strlen(word));
    }
}

}   // namespace

char const* volatile ForeignCall::world_ = nullptr;
char const* volatile ForeignCall::function_ = nullptr;
unsigned long volatile ForeignCall::number_ = 0;

void ForeignCall::tell_crash(int signal) {
    for (Watched const& one : watched) {
        if (one.signal != signal) continue;
        if (function_ != nullptr) {
            say({world_, " crashed (", one.name, " in its function ", function_,
                 "). Mend it; 'lore-world check' runs it alone.\n"});
            function_ = nullptr;
        }
        ::sigaction(signal, &one.before, nullptr);
        ::raise(signal);   // arrives when this handler returns
    }
}

void ForeignCall::tell_delay(int) {
    static unsigned long seen = 0;
    static int seconds = 0;
    bool const same_call = function_ != nullptr && number_ == seen;
    seen = number_;
    seconds = same_call ? seconds + 1 : 0;
    if (seconds < patience) return;
    say({world_, " does not go on (its function ", function_,
         " has not returned in the time allowed). Mend it, or allow more.\n"});
    ::_exit(static_cast<int>(ExitCode::failure));
}

void ForeignCall::watch_signals() {
    static bool const once = [] {
        for (Watched& one : watched) {
            struct sigaction action {};
            action.sa_handler = tell_crash;
            ::sigaction(one.signal, &action, &one.before);
        }
        return true;
    }();
    static_cast<void>(once);
}

void ForeignCall::watch_time(int seconds) {
    patience = seconds;
    struct sigaction action {};
    action.sa_handler = tell_delay;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGALRM, &action, nullptr);
    itimerval const every_second{{1, 0}, {1, 0}};
    ::setitimer(ITIMER_REAL, &every_second, nullptr);
}

}   // namespace lore
