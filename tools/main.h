#pragma once

#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/standard_streams.h>

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

namespace lore {

/// The program's last words, in one line on stderr. What was printed before comes before.
inline int complain(std::string_view program, std::string_view what, ExitCode code) {
    why_stdout_is_lost();   // flushes
    write_stderr(fmt::format("{}: {}\n", program, what));
    return static_cast<int>(code);
}

/// The same of a question about a file that could not be answered, such as whether it is there.
inline int complain(std::string_view program, std::filesystem::filesystem_error const& error) {
    return complain(program, file_error("look at", error.path1(), error.code().value()).what(), ExitCode::failure);
}

/// What to say where stdout could not take the result; nothing where it did.
inline std::string lost_result(std::string_view remedy = "Send it where it can be written.") {
    std::string const reason = why_stdout_is_lost();
    return reason.empty() ? "" : fmt::format("cannot write the result to stdout ({}). {}", reason, remedy);
}

/// The body of main() for programs without MPI: catches everything, says it once, in one line, and returns the exit
/// code.
template <class Run>
int run_program(std::string_view name, Run&& run) {
    own_standard_streams();
    try {
        int const code = run();
        std::string const lost = lost_result();
        return lost.empty() ? code : complain(name, lost, ExitCode::failure);
    } catch (Error const& error) {
        return complain(name, error.what(), error.exit_code());
    } catch (std::filesystem::filesystem_error const& error) {
        return complain(name, error);
    } catch (std::bad_alloc const&) {
        return complain(name, "out of memory", ExitCode::failure);
    } catch (std::exception const& error) {
        // Printing throws too.
        std::string const lost = lost_result();
        return complain(name, lost.empty() ? error.what() : lost, ExitCode::failure);
    }
}

}   // namespace lore
