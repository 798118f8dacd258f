#include <lore/core/standard_streams.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace lore {

void own_standard_streams() {
    for (int const descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) != -1) continue;
        // The lowest free number is this one, since those below are taken by now.
        [[maybe_unused]] int const opened =
            ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);   // inherited by children
    }
    std::signal(SIGPIPE, SIG_IGN);
}

void write_stderr(std::string_view text) noexcept {
    int const before = errno;
    while (!text.empty()) {
        ssize_t const written = ::write(STDERR_FILENO, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) break;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    errno = before;
}

std::string why_stdout_is_lost() {
    static std::string reason;   // the stream itself remembers only that something has failed
    errno = 0;
    bool const flushed = static_cast<bool>(std::cout.flush()) & (std::fflush(stdout) == 0);
    if (reason.empty() && (!flushed || std::ferror(stdout) != 0))
        reason = errno != 0 ? std::strerror(errno) : "a part of it is lost";
    return reason;
}

bool stdout_has_lost_its_reader() {
    pollfd stream{STDOUT_FILENO, 0, 0};
    return ::poll(&stream, 1, 0) == 1 && (stream.revents & POLLERR) != 0;
}

}   // namespace lore
