#pragma once

#include "support/scratch.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lore {

inline std::string file_text(std::string const& path) {
    std::ifstream const file{path, std::ios::binary};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

inline std::vector<pid_t> children_of(pid_t parent) {
    std::istringstream list{
        file_text("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children")};
    std::vector<pid_t> children;
    for (pid_t child = 0; list >> child;) children.push_back(child);
    return children;
}

/// The processes below a launcher that started no others: on this machine, mpirun of Open MPI is the parent of the
/// ranks, that of MPICH their grandparent.
inline std::vector<pid_t> ranks_of(pid_t launcher) {
    std::vector<pid_t> ranks;
    for (pid_t const child : children_of(launcher)) {
        std::vector<pid_t> const below = ranks_of(child);
        if (below.empty()) ranks.push_back(child);
        ranks.insert(ranks.end(), below.begin(), below.end());
    }
    return ranks;
}

/// Dead processes that their parent has not waited for do not count.
inline bool has_living_children(pid_t parent) {
    for (pid_t const child : children_of(parent)) {
        std::string const status = file_text("/proc/" + std::to_string(child) + "/stat");
        std::size_t const name_end = status.rfind(") ");
        if (name_end != std::string::npos && status[name_end + 2] != 'Z' && status[name_end + 2] != 'X') return true;
    }
    return false;
}

/// A program under test, started in a process group of its own with its output in files. What is still alive when the
/// test leaves is killed.
class Command {
public:
    /// Environment settings ("LORE_ISA=v3") may come before the words of the command.
    Command(Scratch const& scratch, std::vector<std::string> words) {
        static int number = 0;
        out_ = scratch.file("command-" + std::to_string(++number) + ".out");
        err_ = out_ + ".err";
        is_launcher_ =
            std::any_of(words.begin(), words.end(), [](std::string const& word) { return word.starts_with("mpirun"); });
        pid_ = ::fork();
        if (pid_ == 0) become(std::move(words));
    }
    Command(Command const&) = delete;
    Command& operator=(Command const&) = delete;
    ~Command() {
        if (!waited_) {
            ::kill(-pid_, SIGKILL);
            wait();
        }
    }

    pid_t pid() const { return pid_; }
    void signal(int number) const { ::kill(pid_, number); }
    bool running() {
        if (waited_) return false;
        int status = 0;
        if (::waitpid(pid_, &status, WNOHANG) == 0) return true;
        keep(status);
        return false;
    }
    /// The exit code, or 128 + the signal that ended it. Open MPI's launcher may wait for ever for a rank that was
    /// killed before the launcher looked for it (docs/design/reliability.md): one that has had no living rank for 20 s
    /// is ended here.
    int wait() {
        for (int alone = 0; running(); std::this_thread::sleep_for(std::chrono::milliseconds{5})) {
            alone = is_launcher_ && !has_living_children(pid_) ? alone + 1 : 0;
            if (alone > 4000) ::kill(pid_, SIGKILL);
        }
        return code_;
    }
    /// False if the condition does not become true in a minute (sanitizers, other work), or the program ends before.
    template <class Condition>
    bool wait_until(Condition const& condition) {
        for (int i = 0; i < 6000; ++i) {
            if (condition()) return true;
            if (!running()) return condition();
            std::this_thread::sleep_for(std::chrono::milliseconds{10});
        }
        return false;
    }
    std::string out() const { return file_text(out_); }
    std::string err() const { return file_text(err_); }

private:
    [[noreturn]] void become(std::vector<std::string> words) const {
        ::setpgid(0, 0);
        ::dup2(::open("/dev/null", O_RDONLY), 0);
        ::dup2(::open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), 1);
        ::dup2(::open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), 2);
        ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
        ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
        ::setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
        // Launchers that end remove the folder that others at once are about to use (docs/design/reliability.md).
        ::setenv("OMPI_MCA_orte_tmpdir_base", (out_ + ".session").c_str(), 1);
        std::vector<char*> arguments;
        for (std::string& word : words) {
            std::size_t const equals = word.find('=');
            if (arguments.empty() && equals != std::string::npos && word.find('/') > equals)
                ::setenv(word.substr(0, equals).c_str(), word.c_str() + equals + 1, 1);
            else arguments.push_back(word.data());
        }
        arguments.push_back(nullptr);
        ::execvp(arguments[0], arguments.data());
        ::_exit(127);
    }
    void keep(int status) {
        waited_ = true;
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    pid_t pid_ = -1;
    bool waited_ = false, is_launcher_ = false;
    int code_ = -1;
    std::string out_, err_;
};

/// The words of a command, in pieces.
inline std::vector<std::string> operator+(std::vector<std::string> left, std::vector<std::string> const& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

inline std::string program(std::string const& name) { return std::string{LORE_BINARY_DIR} + "/bin/" + name; }

/// MPICH's launcher dies of USR2, and its exit code after another signal may be 0 (docs/manual/cluster.md).
inline bool const launcher_is_mpich = std::string{LORE_LAUNCHER}.find("mpich") != std::string::npos;

/// `mpirun` with a number of ranks that may exceed the cores.
inline std::vector<std::string> on_ranks(int ranks) {
    std::istringstream launcher{LORE_LAUNCHER};
    std::vector<std::string> words;
    for (std::string word; launcher >> word;) words.push_back(word);
    return words + std::vector<std::string>{"-n", std::to_string(ranks)};
}

}   // namespace lore
