#include <lore/core/progress.h>

#include <lore/core/standard_streams.h>
#include <lore/core/terminal.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <unistd.h>

namespace lore {

namespace {

constexpr int long_bar = 30, short_bar = 10;
constexpr std::size_t wide_terminal = 110;   ///< columns
constexpr std::chrono::milliseconds redraw_every{100};

}   // namespace

std::string duration_text(double seconds) {
    auto const whole = static_cast<std::int64_t>(std::llround(std::clamp(seconds, 0.0, 1e9)));
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

Progress::Progress(std::string title, std::int64_t total, std::string unit, std::int64_t line_every, bool quiet)
    : title_(std::move(title)), unit_(std::move(unit)), total_(total),
      line_every_(std::max<std::int64_t>(1, line_every)), quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (bar_open_) write_stderr("\n");
}

void Progress::start_at(std::int64_t done) {
    first_ = done;
    began_ = Clock::now();
}

void Progress::tell(std::string_view line) {
    if (quiet_) return;
    write_stderr(fmt::format("{}{}\n", bar_open_ ? "\r\x1b[K" : "", line));
    bar_open_ = false;
    drawn_ = {};
}

void Progress::update(std::int64_t done, std::string_view note) {
    if (quiet_) return;
    bool const last = done >= total_;
    auto const now = Clock::now();
    if (terminal_ ? !last && now - drawn_ < redraw_every : !last && done % line_every_ != 0) return;
    drawn_ = now;
    double const elapsed = std::chrono::duration<double>(now - began_).count();
    std::string time = duration_text(elapsed) + " elapsed";
    if (!last && done > first_)
        time =
            duration_text(elapsed * static_cast<double>(total_ - done) / static_cast<double>(done - first_)) + " left";
    std::string_view const gap = note.empty() ? "" : ", ";
    std::string line;
    if (terminal_) {
        std::size_t const columns = terminal_size().columns;
        int const width = columns < wide_terminal ? short_bar : long_bar;
        auto const filled = static_cast<int>(total_ <= 0 ? width : width * std::min(done, total_) / total_);
        // A line that wrapped could not be drawn over.
        line = fmt::format("\r{}\x1b[K",
                           cut_to_columns(fmt::format("{} [{:=<{}}{:{}}] {}/{} {}, {}{}{}", title_, "", filled, "",
                                                      width - filled, done, total_, unit_, time, gap, note),
                                          columns));
        bar_open_ = !last;
        if (last) line += '\n';
    } else {
        line = fmt::format("{}: {}/{} {}, {}{}{}\n", title_, done, total_, unit_, time, gap, note);
    }
    write_stderr(line);
}

}   // namespace lore
