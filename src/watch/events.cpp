#include <lore/watch/events.h>

#include "curves.h"

#include <lore/archive/checkpoint.h>
#include <lore/core/csv.h>
#include <lore/core/error.h>
#include <lore/core/toml.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/progress_file.h>
#include <lore/experiment/run_directory.h>
#include <lore/world/reward_text.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int event_format = 1;

/// A number, text or list as TOML writes it; what JSON does not know (inf) becomes text.
Json json_of(std::string_view value) {
    Json parsed = Json::parse(value, nullptr, false);
    return parsed.is_discarded() ? Json(std::string{value}) : parsed;
}

/// Every setting by its full name.
Json settings_in(std::string const& config_path) {
    Json settings = Json::object();
    std::string const lines = TomlTable::read_file(config_path).lines();
    for (std::string_view rest = lines; !rest.empty(); rest.remove_prefix(rest.find('\n') + 1)) {
        std::string_view const line = rest.substr(0, rest.find('\n'));
        std::size_t const equals = line.find(" = ");
        settings[std::string{line.substr(0, equals)}] = json_of(line.substr(equals + 3));
    }
    return settings;
}

/// A row of progress.csv: every column by its name.
void add_columns(GenerationSummary const& row, std::string_view reward_unit, Json& event) {
    std::string const header = progress_header(reward_unit);
    std::string const line = text(row);
    CsvFields names{header}, values{line};
    while (auto const name = names.next()) {
        std::string_view const value = *values.next();
        event[std::string{*name}] = json_of(value);   // the distance is no JSON, and becomes text
    }
}

/// Empty text is what is not known.
Json or_null(std::string const& text) { return text.empty() ? Json() : Json(text); }

std::string time_of(FileStamp const& stamp) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(stamp.seconds)));
}

/// "source/007" for runs/source/007 below the directory that is followed; its own name for that itself.
std::string name_of(fs::path const& run, fs::path const& directory) {
    fs::path const relative = run.lexically_relative(directory);
    if (relative == ".") {
        fs::path const whole = fs::absolute(directory).lexically_normal();
        return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
    }
    std::string const name = relative.generic_string();
    return name.starts_with("runs/") ? name.substr(5) : name;
}

/// One run, and what was told of it.
class FollowedRun {
public:
    FollowedRun(std::string path, std::string name) : path_(std::move(path)), name_(std::move(name)) {}

    bool ended() const { return ended_; }

    void look(int every, std::vector<std::string>& lines) {
        FileStamp const manifest = stamp_of(file(run_file::manifest)), progress = stamp_of(file(run_file::progress)),
                        checkpoint = stamp_of(file(run_file::checkpoint));
        if (manifest == manifest_stamp_ && progress == progress_stamp_ && checkpoint == checkpoint_stamp_) return;
        if (!fs::exists(file(run_file::config))) return;   // it is written after the manifest
        try {
            // The manifest first: of what it tells the table has the rows.
            if (manifest != manifest_stamp_) {
                manifest_stamp_ = manifest;
                manifest_is_read_ = false;
                manifest_ = read_manifest(file(run_file::manifest));
                manifest_is_read_ = true;
            }
            if (!manifest_is_read_) return;   // it is told; of what run the rows are nobody knows
            if (progress == FileStamp{}) {    // a run that is made again has none yet
                progress_stamp_ = progress;
                rows_.clear();
            } else if (progress != progress_stamp_) {
                progress_stamp_ = progress;
                rows_ = read_progress(file(run_file::progress));
            }
            tell(every, checkpoint, lines);
        } catch (Error const& error) {
            say({{"event", "unreadable"}, {"run", name_}, {"reason", error.what()}}, lines);
        }
        checkpoint_stamp_ = checkpoint;
    }

private:
    std::string file(char const* name) const { return (fs::path{path_} / name).string(); }

    static void say(Json const& event, std::vector<std::string>& lines) {
        lines.push_back(event.dump(-1, ' ', false, Json::error_handler_t::replace));
    }

    void tell(int every, FileStamp const& checkpoint, std::vector<std::string>& lines) {
        auto const& sessions = manifest_.sessions;
        std::string const started = sessions.empty() ? "" : sessions.front().started;
        if (!begun_ || *begun_ != started) begin(started, lines);
        if (sessions.empty()) tell_rows(rows_.size(), every, false, lines);
        while (sessions_ended_ < sessions.size()) {
            RunSession const& session = sessions[sessions_ended_];
            bool const killed = session.stopped.empty() && sessions_ended_ + 1 < sessions.size();
            bool const over = !session.stopped.empty() || killed;
            if (sessions_begun_ == sessions_ended_) begin_session(session, lines);
            int const last = killed ? sessions[sessions_ended_ + 1].first_generation - 1 : session.last_generation;
            std::size_t const rows = over ? std::min(rows_.size(), static_cast<std::size_t>(last) + 1) : rows_.size();
            tell_rows(rows, every, over, lines);
            if (!over) break;
            end_session(session, killed, last, lines);
        }
        if (manifest_.status == RunStatus::running && checkpoint != checkpoint_stamp_)
            tell_checkpoint(checkpoint, lines);
        if (manifest_.status == RunStatus::done && !ended_) end(lines);
    }

    /// Also of a run that was made again in the same place.
    void begin(std::string const& started, std::vector<std::string>& lines) {
        Json const settings = settings_in(file(run_file::config));
        begun_ = started;
        rows_seen_ = rows_told_ = sessions_begun_ = sessions_ended_ = 0;
        ended_ = false;
        say({{"event", "run_begun"},
             {"run", name_},
             {"format", event_format},
             {"time", or_null(started)},
             {"name", manifest_.name},
             {"world", or_null(manifest_.world.name)},
             {"task", manifest_.task},
             {"reward_unit", manifest_.world.reward_unit},
             {"seed", manifest_.seed},
             {"generations", manifest_.generations},
             {"version", manifest_.build.version},
             {"commit", manifest_.build.commit},
             {"compiler", manifest_.build.compiler},
             {"config", settings}},
            lines);
    }

    void begin_session(RunSession const& session, std::vector<std::string>& lines) {
        ended_ = false;
        say({{"event", "session_begun"},
             {"run", name_},
             {"session", ++sessions_begun_},
             {"time", or_null(session.started)},
             {"first_generation", session.first_generation},
             {"ranks", session.ranks},
             {"instruction_set", session.isa}},
            lines);
    }

    /// Rows that a resumed run has written again are not told again: they are the same.
    void tell_rows(std::size_t until, int every, bool to_the_end, std::vector<std::string>& lines) {
        for (; rows_seen_ < until; ++rows_seen_)
            if (rows_seen_ % static_cast<std::size_t>(every) == 0) tell_row(rows_seen_, lines);
        if (to_the_end && until > rows_told_) tell_row(until - 1, lines);
    }

    void tell_row(std::size_t row, std::vector<std::string>& lines) {
        Json event{{"event", "generation"}, {"run", name_}};
        add_columns(rows_[row], manifest_.world.reward_unit, event);
        say(event, lines);
        rows_told_ = row + 1;
    }

    void end_session(RunSession const& session, bool killed, int last, std::vector<std::string>& lines) {
        say({{"event", "session_ended"},
             {"run", name_},
             {"session", ++sessions_ended_},
             {"time", or_null(session.stopped)},
             {"reason", killed ? "killed" : session.reason},
             {"generation", last},
             {"seconds", killed ? Json() : Json(session.seconds)}},
            lines);
    }

    void tell_checkpoint(FileStamp const& stamp, std::vector<std::string>& lines) {
        if (stamp == FileStamp{}) return;
        std::string const path = file(run_file::checkpoint);
        int generation = 0;
        try {
            generation =
                unpack_checkpoint(read_container(path, FileKind::checkpoint), path).state.population.generation;
        } catch (Error const&) { return; }   // replaced meanwhile; a damaged one is for the run to tell
        say({{"event", "checkpoint"},
             {"run", name_},
             {"time", time_of(stamp)},
             {"generation", generation},
             {"bytes", stamp.size}},
            lines);
    }

    void end(std::vector<std::string>& lines) {
        ended_ = true;
        say({{"event", "run_ended"},
             {"run", name_},
             {"time", or_null(manifest_.sessions.empty() ? "" : manifest_.sessions.back().stopped)},
             {"generation", manifest_.generation},
             {fmt::format("best_{}", reward_word(manifest_.world.reward_unit)),
              json_of(fmt::format("{}", manifest_.best_reward))},
             {"best", manifest_.best},
             {"signature", manifest_.signature},
             {"evaluations", rows_.empty() ? 0 : rows_.back().evaluations},
             {"seconds", rows_.empty() ? 0 : rows_.back().seconds}},
            lines);
    }

    std::string path_, name_;
    FileStamp manifest_stamp_, progress_stamp_, checkpoint_stamp_;   ///< of what was read last
    Manifest manifest_;
    bool manifest_is_read_ = false;   ///< as it is now
    std::vector<GenerationSummary> rows_;
    std::optional<std::string> begun_;            ///< when its first session began, once that was told
    std::size_t rows_seen_ = 0, rows_told_ = 0;   ///< up to the last one seen, and told
    std::size_t sessions_begun_ = 0, sessions_ended_ = 0;
    bool ended_ = false;
};

/// Directories with a manifest, by path; links are not followed.
std::vector<std::string> runs_below(std::string const& directory) {
    std::vector<std::string> runs;
    std::error_code failed;
    if (fs::is_regular_file(fs::path{directory} / run_file::manifest, failed)) return {directory};
    for (fs::recursive_directory_iterator at{directory, fs::directory_options::skip_permission_denied, failed}, end;
         !failed && at != end; at.increment(failed))
        if (at->path().filename() == run_file::manifest && at->is_regular_file(failed))
            runs.push_back(at->path().parent_path().string());
    std::sort(runs.begin(), runs.end());
    return runs;
}

}   // namespace

struct EventReader::Memory {
    std::string directory;
    int every;
    std::map<std::string, FollowedRun> runs;   ///< by path
};

EventReader::EventReader(std::string directory, int every)
    : memory_(std::make_unique<Memory>(Memory{std::move(directory), every, {}})) {}
EventReader::~EventReader() = default;

std::vector<std::string> EventReader::look() {
    std::vector<std::string> lines;
    for (std::string const& path : runs_below(memory_->directory)) {
        auto const known = memory_->runs.try_emplace(path, path, name_of(path, memory_->directory)).first;
        known->second.look(memory_->every, lines);
    }
    return lines;
}

std::size_t EventReader::runs() const { return memory_->runs.size(); }

bool EventReader::ended() const {
    auto const own = memory_->runs.find(memory_->directory);
    return own != memory_->runs.end() && own->second.ended();
}

}   // namespace lore
