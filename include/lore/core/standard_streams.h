#pragma once

#include <string>
#include <string_view>

namespace lore {

/// Makes descriptors 0 to 2 the program's own; to be called first in main(), before anything is opened.
///
/// A descriptor that the caller has closed would be given to the next file that is opened, and what the program prints
/// would be written into it. Each closed one is opened on /dev/null, in the direction in which it is of no use: reading
/// stdin and writing stdout or stderr still fail, so that a lost result is noticed. SIGPIPE is ignored for the same
/// reason: a write into a pipe without a reader fails, and does not end the program.
void own_standard_streams();

/// Writes to stderr: progress, warnings, the one line of an error. What cannot be written is lost without a word, since
/// progress is never a reason to stop a run.
void write_stderr(std::string_view text) noexcept;

/// Whether all that was printed to stdout has left the program, by whatever way it was printed; flushes. Else the
/// reason ("No space left on device"), empty where it is written. A failure is remembered.
std::string why_stdout_is_lost();

/// Whether stdout is a pipe whose reader has gone: nothing printed from now on will be read.
bool stdout_has_lost_its_reader();

}   // namespace lore
