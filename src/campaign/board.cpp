#include <lore/campaign/board.h>

#include <lore/core/standard_streams.h>
#include <lore/core/terminal.h>
#include <lore/core/utf8.h>

#include <algorithm>

#include <fmt/format.h>
#include <unistd.h>

namespace lore {

Board::Board(bool quiet) : quiet_(quiet), live_(!quiet && ::isatty(STDERR_FILENO) != 0) {}
Board::~Board() { erase(); }

void Board::erase() {
    if (lines_.empty()) return;
    write_stderr(fmt::format("\r\033[{}A\033[J", lines_.size()));
    lines_.clear();
}

void Board::announce(std::string const& line) {
    if (!quiet_) complain(line);
}

void Board::complain(std::string const& line) {
    auto kept = lines_;
    erase();
    write_stderr(harmless(line) + "\n");   // it may quote a log
    draw(std::move(kept));
}

void Board::draw(std::vector<std::string> lines) {
    if (!live_ || lines.empty()) return;
    erase();
    TerminalSize const size = terminal_size();
    // The last line tells of the whole: it stays when there are more runs than rows.
    if (lines.size() > size.rows - 1)
        lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(size.rows - 1));
    std::string text;
    for (std::string& line : lines) {
        line = cut_to_columns(line, size.columns);
        text += line + "\n";
    }
    write_stderr(text);
    lines_ = std::move(lines);
}

std::string bar(double share, int width) {
    int const full = static_cast<int>(std::clamp(share, 0.0, 1.0) * width);
    return fmt::format("[{:#<{}}{:.<{}}]", "", full, "", width - full);
}

}   // namespace lore
