#include <lore/experiment/manifest.h>

#include <lore/archive/atomic_file.h>
#include <lore/core/checksum.h>
#include <lore/core/error.h>
#include <lore/core/names.h>
#include <lore/core/whole_number.h>
#include <lore/world/reward_text.h>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

constexpr int manifest_format = 1;
constexpr auto status_names = names_for<RunStatus>("running", "interrupted", "done");

Json to_json(std::vector<FileRecord> const& files) {
    Json list = Json::array();
    for (FileRecord const& file : files) {
        list.push_back({{"role", file.role}, {"path", file.path}, {"bytes", file.bytes}, {"xxh3_64", file.checksum}});
        if (!file.kind.empty()) list.back()["kind"] = file.kind;
    }
    return list;
}

std::vector<FileRecord> files_from(Json const& list) {
    std::vector<FileRecord> files;
    for (Json const& file : list)
        files.push_back({file.at("role"), file.at("path"), whole_number<std::uint64_t>(file.at("bytes")),
                         file.at("xxh3_64"), file.value("kind", "")});
    return files;
}

Json to_json(RunSession const& session) {
    return {{"command_line", session.command_line},
            {"started", session.started},
            {"stopped", session.stopped},
            {"reason", session.reason},
            {"first_generation", session.first_generation},
            {"last_generation", session.last_generation},
            {"ranks", session.ranks},
            {"hosts", session.hosts},
            {"isa", session.isa},
            {"seconds", session.seconds}};
}

RunSession session_from(Json const& json) {
    RunSession session;
    session.command_line = json.at("command_line");
    session.started = json.at("started");
    session.stopped = json.at("stopped");
    session.reason = json.at("reason");
    session.first_generation = whole_number<int>(json.at("first_generation"));
    session.last_generation = whole_number<int>(json.at("last_generation"));
    session.ranks = whole_number<int>(json.at("ranks"));
    session.hosts = json.at("hosts").get<std::vector<std::string>>();
    session.isa = json.at("isa");
    session.seconds = json.at("seconds");
    return session;
}

/// Balls go by the name that they have always had.
Json reward_of(Manifest const& manifest) {
    return {fmt::format("best_{}", reward_word(manifest.world.reward_unit)), json_number<Json>(manifest.best_reward)};
}

}   // namespace

std::string_view name(RunStatus status) { return status_names[status]; }

void write_manifest(std::string const& path, Manifest const& manifest) {
    Json libraries = Json::object();
    for (auto const& [library, version] : manifest.build.libraries) libraries[library] = version;
    Json sessions = Json::array();
    for (RunSession const& session : manifest.sessions) sessions.push_back(to_json(session));
    Json json{{"format", manifest_format},
              {"status", name(manifest.status)},
              {"name", manifest.name},
              {"task", manifest.task},
              {"seed", manifest.seed},
              {"generation", manifest.generation},
              {"generations", manifest.generations},
              {"signature", manifest.signature},
              reward_of(manifest),
              {"best", manifest.best},
              {"build",
               {{"version", manifest.build.version},
                {"commit", manifest.build.commit},
                {"compiler", manifest.build.compiler},
                {"build_type", manifest.build.build_type},
                {"libraries", libraries}}},
              {"inputs", to_json(manifest.inputs)},
              {"outputs", to_json(manifest.outputs)},
              {"sessions", sessions}};
    if (!manifest.world.name.empty()) json["world"] = Json::parse(to_json(manifest.world));
    // A command line may hold any bytes; those that are no UTF-8 are replaced.
    write_file_atomically(path, std::string_view{json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"});
}

Manifest read_manifest(std::string const& path) {
    auto const bytes = read_file(path);
    try {
        auto const* const text = reinterpret_cast<char const*>(bytes.data());
        Json const json = Json::parse(text, text + bytes.size(), refuse_deep_nesting<Json>);
        if (int const format = whole_number<int>(json.at("format")); format > manifest_format)
            throw Error(fmt::format("cannot read {}", path),
                        fmt::format("written by a newer Lore: format {}, this one reads {}", format, manifest_format),
                        "Update Lore.");
        Manifest manifest;
        std::string const status = json.at("status");
        auto const known = status_names.find(status);
        if (!known) throw std::out_of_range("unknown status '" + status + "'");
        manifest.status = *known;
        manifest.name = json.at("name");
        manifest.task = json.at("task");
        manifest.seed = whole_number<std::uint64_t>(json.at("seed"));
        manifest.generation = whole_number<int>(json.at("generation"));
        manifest.generations = whole_number<int>(json.at("generations"));
        manifest.signature = json.at("signature");
        manifest.best_reward = json.at(json.contains("best_reward") ? "best_reward" : "best_balls").get<double>();
        if (json.contains("world")) {
            manifest.world = parse_world_record(json.at("world").dump());
        } else {
            manifest.world.task = manifest.task;
            manifest.world.reward_unit = first_reward_unit;
        }
        manifest.best = json.at("best");
        Json const& build = json.at("build");
        manifest.build = {build.at("version"), build.at("commit"), build.at("compiler"), build.at("build_type"), {}};
        for (auto const& [library, version] : build.at("libraries").items())
            manifest.build.libraries.emplace_back(library, version);
        manifest.inputs = files_from(json.at("inputs"));
        manifest.outputs = files_from(json.at("outputs"));
        for (Json const& session : json.at("sessions")) manifest.sessions.push_back(session_from(session));
        return manifest;
    } catch (Error const&) { throw; } catch (std::exception const& error) {
        throw Error(fmt::format("cannot read {}", path), error.what(), "Take a copy that is whole.");
    }
}

FileRecord record_of(std::string const& role, std::string const& path, std::string const& shown_as) {
    std::string const sum = checksum_text(checksum_of_file(path));   // refuses what has no size
    return {role, shown_as, static_cast<std::uint64_t>(std::filesystem::file_size(path)), sum, ""};
}

FileRecord record_of_text(std::string const& role, std::string_view text, std::string const& shown_as) {
    return {role, shown_as, text.size(), checksum_text(checksum(text)), ""};
}

FileRecord const* find_role(std::vector<FileRecord> const& files, std::string_view role) {
    auto const found = std::find_if(files.begin(), files.end(), [&](auto const& file) { return file.role == role; });
    return found == files.end() ? nullptr : &*found;
}

std::vector<FileRecord> with_role(std::vector<FileRecord> const& files, std::string_view role) {
    std::vector<FileRecord> found;
    std::copy_if(files.begin(), files.end(), std::back_inserter(found),
                 [&](FileRecord const& file) { return file.role == role; });
    return found;
}

FileRecord const* find_path(std::vector<FileRecord> const& files, std::string_view path) {
    auto const found = std::find_if(files.begin(), files.end(), [&](auto const& file) { return file.path == path; });
    return found == files.end() ? nullptr : &*found;
}

std::string time_stamp() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

}   // namespace lore
