#include "process_child.h"

#include <lore/core/child_signals.h>
#include <lore/core/error.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

namespace lore {

namespace {

constexpr double seconds_to_end = 2;   ///< after its input was closed

struct Pipe {
    FileDescriptor from, to;
};

Pipe make_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Error("cannot start a world's process", std::strerror(errno),
                    "Raise the limit of open files (ulimit -n).");
    return {FileDescriptor{ends[0]}, FileDescriptor{ends[1]}};
}

/// Ours, and that the child is the process of a world.
std::vector<char*> environment_of_worlds() {
    static char entry[] = "LORE_WORLD_PROCESS=1";
    std::vector<char*> environment{entry};
    for (char** each = environ; *each != nullptr; ++each) environment.push_back(*each);
    environment.push_back(nullptr);
    return environment;
}

/// The child's way to its program. Only what is safe between fork and exec.
[[noreturn]] void become(char* const* arguments, char* const* environment, char const* folder, int input, int output,
                         int failures, pid_t parent) {
    ::setpgid(0, 0);
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);   // it died before the line above
#ifdef CLOSE_RANGE_CLOEXEC
    ::close_range(3, ~0u, CLOSE_RANGE_CLOEXEC);   // a lock of ours, say, would be held on
#endif
#else
    static_cast<void>(parent);
#endif
    give_signals_back();
    ::dup2(input, STDIN_FILENO);
    ::dup2(output, STDOUT_FILENO);
    if (*folder == '\0' || ::chdir(folder) == 0) ::execvpe(arguments[0], arguments, environment);
    int const reason = errno;
    [[maybe_unused]] auto const told = ::write(failures, &reason, sizeof reason);
    ::_exit(127);
}

void ignore_broken_pipes() {
    struct sigaction action {};
    if (::sigaction(SIGPIPE, nullptr, &action) == 0 && action.sa_handler == SIG_DFL) ::signal(SIGPIPE, SIG_IGN);
}

std::string ending(siginfo_t const& info) {
    return info.si_code == CLD_EXITED ? fmt::format("exit code {}", info.si_status)
                                      : fmt::format("signal {}, {}", info.si_status, ::strsignal(info.si_status));
}

[[noreturn]] void refuse_start(std::string const& program, std::string const& folder, int reason) {
    if (!folder.empty() && !std::filesystem::is_directory(folder))
        throw UsageError(fmt::format("cannot start {} in {}", program, folder), "there is no such folder",
                         "Put it back, or correct 'folder' in [world] of the configuration.");
    throw UsageError(fmt::format("cannot start {}{}{}", program, folder.empty() ? "" : " in ", folder),
                     std::strerror(reason), "Install it, or correct 'process' in [world] of the configuration.");
}

}   // namespace

ProcessChild::ProcessChild(std::vector<std::string> const& command, std::string const& folder) {
    ignore_broken_pipes();
    Pipe input = make_pipe(), output = make_pipe(), failures = make_pipe();
    std::vector<char*> arguments;
    for (std::string const& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::vector<char*> const environment = environment_of_worlds();
    pid_t const parent = ::getpid();
    id_ = ::fork();
    if (id_ < 0)
        throw Error("cannot start a world's process", std::strerror(errno), "Free memory, or end other processes.");
    if (id_ == 0)
        become(arguments.data(), environment.data(), folder.c_str(), input.from.get(), output.to.get(),
               failures.to.get(), parent);
    ::setpgid(id_, id_);   // here too: parent or child may come first
    failures.to.close();
    int reason = 0;   // nothing comes, and the pipe is closed, where the program has begun
    ssize_t got = 0;
    do got = ::read(failures.from.get(), &reason, sizeof reason);
    while (got < 0 && errno == EINTR);
    if (got == sizeof reason) {
        kill();
        refuse_start(command[0], folder, reason);
    }
    input_ = std::move(input.to);
    output_ = std::move(output.from);
    for (int const ours : {input_.get(), output_.get()}) ::fcntl(ours, F_SETFL, O_NONBLOCK);
}

ProcessChild::~ProcessChild() {
    input_.close();
    end(seconds_to_end);
    kill();
}

std::optional<std::string> ProcessChild::end(double seconds) {
    using Clock = std::chrono::steady_clock;
    auto const limit = Clock::now() + std::chrono::duration<double>{seconds};
    while (id_ >= 0) {
        siginfo_t info{};
        // Not waited for yet: until then no other process can be given its number, by which its group is killed.
        int const failed = ::waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT);
        if (failed != 0 && errno != EINTR) return "in a way that another part of the program has learned";
        if (failed == 0 && info.si_pid == id_) return ending(info);
        if (Clock::now() >= limit) return std::nullopt;
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    return std::nullopt;
}

void ProcessChild::kill() {
    if (id_ < 0) return;
    ::kill(-id_, SIGKILL);
    ::kill(id_, SIGKILL);   // where it has left its group
    while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {}
    id_ = -1;
}

}   // namespace lore
