#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace lore {

/// Shows on stderr how far a long work has come: a bar with the time left where stderr is a terminal, otherwise a line
/// every so many steps; nothing in quiet mode.
class Progress {
public:
    /// `total` steps of `unit` ("generations"); without a terminal a line every `line_every` steps.
    Progress(std::string title, std::int64_t total, std::string unit, std::int64_t line_every, bool quiet);
    ~Progress();
    Progress(Progress const&) = delete;
    Progress& operator=(Progress const&) = delete;

    /// `done` steps are done in all; `note` follows the figures ("best 4 balls").
    void update(std::int64_t done, std::string_view note = "");
    /// A line of its own; the bar goes on below it.
    void tell(std::string_view line);
    /// The work began at `done` (after a resume), so that the time left is not reckoned from what others did.
    void start_at(std::int64_t done);

private:
    using Clock = std::chrono::steady_clock;
    std::string title_, unit_;
    std::int64_t total_, line_every_;
    std::int64_t first_ = 0;
    bool quiet_, terminal_;
    bool bar_open_ = false;
    Clock::time_point began_ = Clock::now();
    Clock::time_point drawn_{};
};

/// "1:02:03" or "2:03".
std::string duration_text(double seconds);

}   // namespace lore
