#include <lore/core/error.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace lore {

namespace {

std::string one_line(std::string_view problem, std::string_view reason, std::string_view remedy) {
    std::string line{problem};
    if (!reason.empty()) line.append(" (").append(reason).append(")");
    line.append(".");
    if (!remedy.empty()) line.append(" ").append(remedy);
    // A file's name or a program's words may hold anything; a terminal obeys control characters.
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    return line;
}

std::size_t edits_between(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            std::size_t const substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
        }
    }
    return row[b.size()];
}

}   // namespace

Error::Error(std::string_view problem, std::string_view reason, std::string_view remedy, ExitCode code)
    : std::runtime_error(one_line(problem, reason, remedy)), problem_(problem), reason_(reason), remedy_(remedy),
      code_(code) {}

std::string nearest_word(std::string_view typed, std::string_view const* candidates, std::size_t count) {
    std::string best;
    std::size_t fewest = std::max<std::size_t>(2, typed.size() / 3) + 1;
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t const edits = edits_between(typed, candidates[i]);
        if (edits < fewest) {
            fewest = edits;
            best = candidates[i];
        }
    }
    return best;
}

}   // namespace lore
