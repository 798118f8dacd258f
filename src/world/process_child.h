#pragma once

#include <lore/core/file.h>

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace lore {

/// A program at work whose standard input and output are pipes of ours; its standard error is our own.
///
/// It is in a process group of its own, inherits no other descriptor, and is killed where our thread dies (Linux).
class ProcessChild {
public:
    /// Throws UsageError where `command` cannot be started in `folder` ("": the working directory).
    ProcessChild(std::vector<std::string> const& command, std::string const& folder);
    ProcessChild(ProcessChild const&) = delete;
    ProcessChild& operator=(ProcessChild const&) = delete;
    /// Closes its input, gives it time to end, and kills what is left of its group.
    ~ProcessChild();

    pid_t id() const { return id_; }
    int input() const { return input_.get(); }     ///< what we write; does not block
    int output() const { return output_.get(); }   ///< what we read; does not block

    /// How it has ended, "exit code 3", once it has, unless we killed it; waits for that up to `seconds`.
    std::optional<std::string> end(double seconds = 0);
    /// Kills its group, and waits for it.
    void kill();

private:
    pid_t id_ = -1;   ///< -1: waited for
    FileDescriptor input_, output_;
};

}   // namespace lore
