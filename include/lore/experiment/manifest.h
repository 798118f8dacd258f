#pragma once

#include <lore/archive/world_record.h>
#include <lore/experiment/version.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

enum class RunStatus : std::uint8_t { running, interrupted, done };
std::string_view name(RunStatus);

/// Parts that files play in a run.
namespace file_role {
inline constexpr char configuration[] = "configuration", arena[] = "arena", world[] = "world",
                      knowledge[] = "knowledge base", founders[] = "founders", output[] = "output";
}   // namespace file_role

/// A file that went into a run or came out of it, and what it was like.
struct FileRecord {
    std::string role;   ///< a file_role
    std::string path;   ///< inputs as given, outputs relative to the run's directory
    std::uint64_t bytes = 0;
    std::string checksum;    ///< XXH3-64, 16 hexadecimal digits
    std::string kind = {};   ///< of founders: FoundersOrigin::kind; else empty, and not written
};

/// One start of the program on this run.
struct RunSession {
    std::string command_line;
    std::string started, stopped;   ///< UTC, ISO 8601; stopped is empty while it runs, or if it was killed
    int first_generation = 0;       ///< the generation it started from
    int last_generation = 0;        ///< as of the stop or the end
    int ranks = 1;
    std::vector<std::string> hosts;
    std::string isa;
    double seconds = 0;   ///< of wall time
    std::string reason;   ///< of the stop: "done", "signal 15", "time limit", ...
};

/// Provenance of a run: manifest.json (docs/manual/formats.md).
struct Manifest {
    RunStatus status = RunStatus::running;
    std::string name;
    std::string task;
    std::uint64_t seed = 1;
    std::string signature;    ///< as of the last stop or the end; empty until then
    int generation = 0;       ///< likewise
    int generations = 0;      ///< that the run is to reach
    double best_reward = 0;   ///< of the best-of-run, likewise
    WorldRecord world;        ///< of a run by an earlier version: collectball's, without more than its names
    std::string best;         ///< its id
    BuildInformation build;
    std::vector<FileRecord> inputs, outputs;
    std::vector<RunSession> sessions;
};

void write_manifest(std::string const& path, Manifest const&);
/// Throws Error: missing, not JSON, or a field missing or of another type.
Manifest read_manifest(std::string const& path);

/// Throws Error: missing, or no regular file.
FileRecord record_of(std::string const& role, std::string const& path, std::string const& shown_as);
/// Of a file that was read before, since it may be a pipe.
FileRecord record_of_text(std::string const& role, std::string_view text, std::string const& shown_as);
/// The first with that role, or null.
FileRecord const* find_role(std::vector<FileRecord> const&, std::string_view role);
/// All with this role, in their order.
std::vector<FileRecord> with_role(std::vector<FileRecord> const&, std::string_view role);
/// The first with that path, or null.
FileRecord const* find_path(std::vector<FileRecord> const&, std::string_view path);
/// Now, UTC, as "2025-01-31T12:00:00Z".
std::string time_stamp();

}   // namespace lore
