#include <lore/core/child_signals.h>

#include <csignal>
#include <initializer_list>

namespace lore {

void give_signals_back() {
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    for (int const signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU, SIGCHLD, SIGPIPE})
        ::signal(signal, SIG_DFL);
}

}   // namespace lore
