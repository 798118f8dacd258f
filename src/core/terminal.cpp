#include <lore/core/terminal.h>

#include <algorithm>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace lore {

TerminalSize terminal_size() {
    winsize size{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0 || size.ws_col == 0) return {};
    return {size.ws_row, size.ws_col};
}

std::string cut_to_columns(std::string_view line, std::size_t columns) {
    // The last column stays free: some terminals wrap as soon as it is written to.
    return fmt::format("{:.{}}", line, std::max<std::size_t>(columns, 1) - 1);   // by code points
}

}   // namespace lore
