#include "child.h"

#include <lore/core/child_signals.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/input_file.h>
#include <lore/experiment/manifest.h>

#include <lore/campaign/steps.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lore {

pid_t start_child(std::vector<std::string> const& command, std::string const& log, int inherited) {
    make_directory(std::filesystem::path{log}.parent_path().string());
    int const output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (output < 0)
        throw Error(fmt::format("cannot write {}", log), std::strerror(errno),
                    "Choose a directory that can be written.");
    std::string const heading = fmt::format("== {} {}\n", time_stamp(), shell_text(command));
    [[maybe_unused]] auto const written = ::write(output, heading.data(), heading.size());

    std::vector<char*> arguments;
    for (std::string const& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);

    pid_t const pid = ::fork();
    if (pid < 0) {
        int const reason = errno;
        ::close(output);
        throw Error("cannot start another program", std::strerror(reason), "Start fewer at a time with --jobs.");
    }
    if (pid == 0) {
        // Only what is safe between fork and exec, but for strerror once exec has failed.
        ::setpgid(0, 0);
        give_signals_back();
        int const nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
        ::dup2(nothing, STDIN_FILENO);
        ::dup2(output, STDOUT_FILENO);
        ::dup2(output, STDERR_FILENO);
        if (inherited >= 0) ::fcntl(inherited, F_SETFD, 0);
        ::execvp(arguments[0], arguments.data());
        char const* const reason = std::strerror(errno);
        for (char const* part : {"cannot start ", static_cast<char const*>(arguments[0]), " (", reason, ")\n"})
            [[maybe_unused]] auto const said = ::write(STDERR_FILENO, part, std::strlen(part));
        ::_exit(127);
    }
    ::setpgid(pid, pid);   // here too: parent or child may come first
    ::close(output);
    return pid;
}

std::optional<ChildEnd> poll_child(pid_t pid) {
    int status = 0;
    if (::waitpid(pid, &status, WNOHANG) != pid) return std::nullopt;
    if (WIFSIGNALED(status)) return ChildEnd{0, WTERMSIG(status)};
    return ChildEnd{WEXITSTATUS(status), 0};
}

std::string text(ChildEnd const& end) {
    return end.signal != 0 ? fmt::format("signal {}", end.signal) : fmt::format("exit code {}", end.exit_code);
}

void append_to_log(std::string const& path, std::string const& line) {
    std::ofstream{path, std::ios::app} << line << "\n";
}

std::vector<std::string> last_lines(std::string const& path, std::size_t count) {
    std::istringstream tail;
    try {
        tail.str(last_bytes(open_regular(path), 16384));
    } catch (Error const&) { return {}; }   // no log is no reason to stop
    std::deque<std::string> lines;
    for (std::string line; std::getline(tail, line);) {
        if (line.empty() || line.starts_with("== ")) continue;
        lines.push_back(line.substr(0, 400));
        if (lines.size() > count) lines.pop_front();
    }
    return {lines.begin(), lines.end()};
}

}   // namespace lore
