#include <lore/world/open.h>

#include <lore/core/checksum.h>
#include <lore/core/error.h>
#include <lore/core/input_file.h>
#include <lore/core/installation.h>
#include <lore/world/library.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace fs = std::filesystem;

namespace {

/// Of an installed Lore: bin/lore-world and lib/lore/worlds.
fs::path installed_worlds() {
    fs::path const program = own_program();
    return program.empty() ? program : program.parent_path().parent_path() / LORE_LIBRARY_FOLDER / "lore" / "worlds";
}

std::vector<std::string> places_to_look(std::string const& folder) {
    std::vector<std::string> places{folder.empty() ? "." : folder};
    if (char const* const path = std::getenv("LORE_WORLD_PATH")) {
        std::string_view rest{path};
        while (!rest.empty()) {
            std::size_t const end = std::min(rest.find(':'), rest.size());
            if (end > 0) places.emplace_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    if (fs::path const installed = installed_worlds(); !installed.empty()) places.push_back(installed.string());
    return places;
}

bool is_file(fs::path const& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

/// Null for a name that is of none of them.
BuiltinWorld const* builtin_of(std::string const& name, std::span<BuiltinWorld const> builtins) {
    if (name.find('/') != std::string::npos) return nullptr;
    auto const found = std::find_if(builtins.begin(), builtins.end(), [&](BuiltinWorld const& builtin) {
        return builtin.name == std::string_view{name}.substr(0, name.find(':'));
    });
    return found == builtins.end() ? nullptr : &*found;
}

OpenedWorld open_builtin(BuiltinWorld const& builtin, WorldRequest const& request, std::string const& task) {
    // Before the braces: g++ 12 destroys the first member twice where the second throws.
    std::unique_ptr<World> world = builtin.open(task, request.settings);
    return {{"", 0, 0, request.settings}, std::move(world)};
}

OpenedWorld open_process(WorldRequest const& request) {
    WorldOrigin origin{"", 0, 0, request.settings, request.process};
    std::vector<std::string> const files = files_of(request.process, request.folder);
    std::string checksums;
    for (std::string const& file : files) {
        checksums += checksum_text(checksum_of_file(file));
        origin.bytes += open_regular(file).size;
    }
    if (files.size() == 1) origin.checksum = checksum_of_file(files[0]);
    else if (files.size() > 1) origin.checksum = checksum(checksums);
    return {std::move(origin), start_world({request.process, request.folder, request.patience}, request.settings)};
}

[[noreturn]] void refuse_builtin(std::string const& name, std::span<BuiltinWorld const> builtins) {
    std::vector<std::string_view> names;
    for (BuiltinWorld const& builtin : builtins) names.push_back(builtin.name);
    std::string const meant = nearest_word(name, names.data(), names.size());
    throw UsageError(
        fmt::format("there is no built-in world '{}'", name), fmt::format("those are: {}", fmt::join(names, ", ")),
        meant.empty() ? "Correct the name, or give the path of a library." : fmt::format("Did you mean '{}'?", meant));
}

}   // namespace

std::string text(WorldOrigin const& origin) {
    return origin.command.empty() ? origin.file : fmt::format("{}", fmt::join(origin.command, " "));
}

std::vector<std::string> files_of(std::vector<std::string> const& command, std::string const& folder) {
    std::vector<std::string> files;
    for (std::size_t i = 0; i < command.size(); ++i) {
        bool const along_path = i == 0 && command[0].find('/') == std::string::npos;
        fs::path const path = fs::path{folder} / command[i];   // the word alone where it is absolute
        if (!along_path && is_file(path)) files.push_back(path.string());
    }
    return files;
}

std::string find_library(std::string const& name, std::string const& folder) {
    if (name.find('/') != std::string::npos) {
        fs::path const path = fs::path{folder} / name;   // name alone where it is absolute or there is no folder
        open_regular(path.string());                     // says what is wrong with the path
        return path.string();
    }
    bool const has_ending = name.ends_with(".so");
    std::vector<std::string> const files =
        has_ending ? std::vector{name} : std::vector{name + ".so", "lib" + name + ".so"};
    std::vector<std::string> const places = places_to_look(folder);
    for (std::string const& place : places)
        for (std::string const& file : files)
            if (fs::path const path = fs::path{place} / file; is_file(path)) return path.string();
    throw UsageError(fmt::format("cannot find world {}", name),
                     fmt::format("there is no {} in {}", fmt::join(files, " or "), fmt::join(places, ", ")),
                     "Compile it, give its path with a '/', or name its folder in LORE_WORLD_PATH.");
}

std::vector<std::string> files_of(WorldRequest const& request, std::span<BuiltinWorld const> builtins) {
    if (!request.process.empty()) return files_of(request.process, request.folder);
    if (builtin_of(request.name, builtins) != nullptr) return {};
    return {find_library(request.name, request.folder)};
}

OpenedWorld open_world(WorldRequest const& request, std::span<BuiltinWorld const> builtins) {
    if (!request.process.empty()) return open_process(request);
    std::size_t const colon = request.name.find(':');
    if (BuiltinWorld const* const builtin = builtin_of(request.name, builtins))
        return open_builtin(*builtin, request, colon == std::string::npos ? "" : request.name.substr(colon + 1));
    bool const is_path = request.name.find('/') != std::string::npos;
    if (!is_path && colon != std::string::npos) refuse_builtin(request.name.substr(0, colon), builtins);
    std::string const file = find_library(request.name, request.folder);
    WorldOrigin origin{file, checksum_of_file(file), open_regular(file).size, request.settings};
    return {std::move(origin), load_world(file, request.settings)};
}

}   // namespace lore
