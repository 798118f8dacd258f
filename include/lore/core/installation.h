#pragma once

#include <string>

namespace lore {

/// The path of the program that runs; empty where the system does not tell.
std::string own_program();

/// The directory of tasks, campaigns and batch scripts that belongs to this program: share/lore/jobs beside an
/// installed one, jobs of the repository for one in a build folder of it; empty where there is neither.
std::string jobs_directory();

/// The remedy for a file that is not there: where the jobs are, for a path below jobs/; else the file of nearly that
/// name in the same directory, if there is one.
std::string remedy_for_missing(std::string const& path);

}   // namespace lore
