#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace lore {

/// What a program returns to its caller; scripts and batch systems rely on these numbers.
enum class ExitCode : int {
    done = 0,
    failure = 1,       ///< any failure that is not the user's spelling
    usage = 2,         ///< command line or configuration
    interrupted = 75   ///< stopped at a checkpoint: run me again (EX_TEMPFAIL)
};

/// The world's fault, never ours (ours are assertions): a file, a setting, a full disk.
///
/// what() is one line: "problem (why it is one). What to do?"
/// Only main() catches it, prints it once, and returns exit_code().
class Error : public std::runtime_error {
public:
    Error(std::string_view problem, std::string_view reason, std::string_view remedy,
          ExitCode code = ExitCode::failure);
    ExitCode exit_code() const { return code_; }
    /// The parts of the line, for whoever can say more precisely what the problem is with.
    std::string const& problem() const { return problem_; }
    std::string const& reason() const { return reason_; }
    std::string const& remedy() const { return remedy_; }

private:
    std::string problem_, reason_, remedy_;
    ExitCode code_;
};

/// An Error of the command line or of a configuration file: exit code 2.
class UsageError : public Error {
public:
    UsageError(std::string_view problem, std::string_view reason, std::string_view remedy)
        : Error(problem, reason, remedy, ExitCode::usage) {}
};

/// The candidate nearest to a mistyped word by edit distance, or "" if none is close enough to be meant.
std::string nearest_word(std::string_view typed, std::string_view const* candidates, std::size_t count);

}   // namespace lore
