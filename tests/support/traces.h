#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <zlib.h>

namespace lore::tests {

/// One row of a trace recorded with the predecessor's simulator (columns: see its README).
struct TraceRow {
    std::array<double, 30> field{};
    double x() const { return field[1]; }
    double y() const { return field[2]; }
    double theta() const { return field[3]; }
    double sensor(int i) const { return field[static_cast<std::size_t>(4 + i)]; }
    double action(int i) const { return field[static_cast<std::size_t>(16 + i)]; }
    int carrying() const { return static_cast<int>(field[19]); }
    int door_open() const { return static_cast<int>(field[20]); }
    int balls_mask() const { return static_cast<int>(field[21]); }
    int collected() const { return static_cast<int>(field[22]); }
    int switch_on() const { return static_cast<int>(field[24]); }
    int switch_timer() const { return static_cast<int>(field[25]); }
    double x_next() const { return field[27]; }
    double y_next() const { return field[28]; }
    double theta_next() const { return field[29]; }
};

/// The recorded traces' files, or none where the folder is absent.
inline std::vector<std::filesystem::path> recorded_traces() {
    std::vector<std::filesystem::path> places;
    if (char const* shared = std::getenv("LORE_SHARED")) places.emplace_back(shared);
    places.emplace_back(std::string{LORE_SOURCE_DIR} + "/../shared");
    places.emplace_back(std::string{LORE_SOURCE_DIR} + "/../../shared");
    std::vector<std::filesystem::path> files;
    for (auto const& place : places) {
        if (!files.empty() || !std::filesystem::is_directory(place / "traces")) continue;
        for (auto const& entry : std::filesystem::directory_iterator{place / "traces"})
            if (entry.path().extension() == ".gz") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

inline std::vector<TraceRow> read_trace(std::filesystem::path const& path) {
    gzFile const file = gzopen(path.c_str(), "rb");
    if (file == nullptr) throw std::runtime_error("cannot open " + path.string());
    std::vector<TraceRow> rows;
    char line[4096];
    bool header = true;
    while (gzgets(file, line, sizeof line) != nullptr) {
        if (!std::exchange(header, false)) {
            TraceRow row;
            char* at = line;
            for (int i = 0; i < 30; ++i) {
                row.field[static_cast<std::size_t>(i)] = std::strtod(at, &at);
                if (*at == ',') ++at;
            }
            rows.push_back(row);
        }
    }
    gzclose(file);
    return rows;
}

}   // namespace lore::tests
