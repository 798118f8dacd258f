#pragma once

#include "task.h"

#include <string>
#include <vector>

namespace lore {

/// What people read of a campaign at work. Pure functions of its tasks.

/// A line a working step: its bar, generation, best robot and time left.
std::vector<std::string> step_lines(std::vector<Task> const&);

/// The campaign as a whole, with the time left if `jobs` steps are worked on at a time.
std::string overall_line(std::vector<Task> const&, int jobs);

/// The last line of a session.
std::string summary_line(std::vector<Task> const&);

/// Of a step that was just started.
std::string started_line(Task const&);

}   // namespace lore
