#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace lore {

/// How a started program ended.
struct ChildEnd {
    int exit_code = 0;
    int signal = 0;   ///< that ended it; 0: it returned exit_code
};

/// Starts a program in a process group of its own (so that Ctrl-C reaches it only through us), its output appended to
/// `log`, its input empty, every signal as usual, and `inherited` left open in it. Returns its process id.
/// Throws Error if the log cannot be written; a program that cannot be started ends with 127.
pid_t start_child(std::vector<std::string> const& command, std::string const& log, int inherited);

/// The end of a started program, or nothing while it runs.
std::optional<ChildEnd> poll_child(pid_t);

/// "exit code 1" or "signal 9".
std::string text(ChildEnd const&);

/// Adds a line to a log, if it can be written.
void append_to_log(std::string const& path, std::string const& line);

/// The last `count` lines of a file that say something; empty if it cannot be read.
std::vector<std::string> last_lines(std::string const& path, std::size_t count);

}   // namespace lore
