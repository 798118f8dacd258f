#include "launcher_watch.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace lore {

namespace {

// Files of /proc are read as they are: the kernel makes them, and a process that has ended has none.

/// Children of all threads of a process, the dead ones among them.
std::vector<pid_t> children_of(pid_t process) {
    std::vector<pid_t> children;
    std::error_code failed;
    std::filesystem::directory_iterator thread{fmt::format("/proc/{}/task", process), failed};
    for (; !failed && thread != std::filesystem::directory_iterator{}; thread.increment(failed)) {
        std::ifstream list{thread->path() / "children"};
        for (pid_t child = 0; list >> child;) children.push_back(child);
    }
    return children;
}

struct Process {
    std::string name;
    bool alive = false;
};

/// Not alive, without a name, if there is none.
Process process(pid_t id) {
    std::ifstream file{fmt::format("/proc/{}/stat", id)};
    std::string line;
    std::getline(file, line);
    // 12 (name) S ...: the name may hold any character.
    std::size_t const begin = line.find('('), end = line.rfind(')');
    if (begin == std::string::npos || end == std::string::npos || end + 2 >= line.size()) return {};
    char const state = line[end + 2];
    return {line.substr(begin + 1, end - begin - 1), state != 'Z' && state != 'X'};
}

}   // namespace

Ranks ranks_of(pid_t launcher, std::string_view program) {
    Ranks ranks;
    for (pid_t const child : children_of(launcher)) {
        Process const found = process(child);
        if (found.name == program) ++(found.alive ? ranks.living : ranks.dead);
        Ranks const below = ranks_of(child, program);
        ranks.living += below.living;
        ranks.dead += below.dead;
    }
    return ranks;
}

bool LauncherWatch::hangs(Ranks ranks, Clock::time_point now) {
    if (ranks.living + ranks.dead > 0) had_rank_ = true;
    if (ranks.living > 0) {
        alone_since_.reset();
        return false;
    }
    if (!had_rank_) return false;
    if (!alone_since_) alone_since_ = now;
    return now - *alone_since_ >= patience_;
}

}   // namespace lore
