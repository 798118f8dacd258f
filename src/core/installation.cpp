#include <lore/core/installation.h>

#include <lore/core/error.h>

#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace lore {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view jobs = "jobs";
constexpr std::size_t shortest_name = 4;   ///< of shorter ones, all are like each other
constexpr std::size_t most_names = 1000;

bool is_there(fs::path const& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

std::string similar_name_beside(fs::path const& path) {
    std::string const typed = path.filename().string();
    if (typed.size() < shortest_name) return "";
    std::vector<std::string> names;
    std::error_code failed;
    fs::directory_iterator entry{path.has_parent_path() ? path.parent_path() : fs::path{"."}, failed};
    for (; !failed && entry != fs::directory_iterator{} && names.size() < most_names; entry.increment(failed))
        names.push_back(entry->path().filename().string());
    std::vector<std::string_view> const words(names.begin(), names.end());
    return nearest_word(typed, words.data(), words.size());
}

}   // namespace

std::string own_program() {
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).string();
}

std::string jobs_directory() {
    fs::path const folder = fs::path{own_program()}.parent_path();
    if (folder.empty()) return "";
    for (fs::path const& place : {folder.parent_path() / LORE_DATA_FOLDER / "lore" / jobs,
                                  folder.parent_path().parent_path().parent_path() / jobs})
        if (is_there(place / "tasks" / "source.toml")) return place.string();
    return "";
}

std::string remedy_for_missing(std::string const& path) {
    fs::path const wanted = fs::path{path}.lexically_normal();
    if (!wanted.empty() && *wanted.begin() == fs::path{jobs}) {
        std::string const here = jobs_directory();
        if (!here.empty() && is_there(fs::path{here}.parent_path() / wanted))
            return fmt::format("It is in {}: copy that with 'cp -r {} .', or give the path there.", here, here);
    }
    std::string const meant = similar_name_beside(wanted);
    return meant.empty() ? "Check the path." : fmt::format("Did you mean '{}'?", meant);
}

}   // namespace lore
