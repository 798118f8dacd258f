#pragma once

#include <string>

namespace lore {

/// From now on USR1, USR2, TERM, INT and XCPU only ask for a stop; a second one, half a second later or more, ends the
/// process at once. (Launchers may deliver one signal twice. The kernel repeats XCPU every second: it stays a request.)
/// A write beyond the file size limit, or to a closed pipe, becomes an error instead of the end.
void install_stop_handlers();
/// On the ranks that take orders: the same signals do nothing, because rank 0 decides when all stop.
void ignore_stop_signals();

/// "signal 10 (User defined signal 1)", or "" if none has arrived.
std::string stop_request();

}   // namespace lore
