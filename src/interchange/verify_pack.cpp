#include <lore/interchange/verify_pack.h>

#include "archive_file.h"
#include "crate_reading.h"
#include "inventory.h"

#include <lore/core/directory.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/input_file.h>
#include <lore/experiment/verification.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <map>
#include <set>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

/// Of all files together that describe others [bytes]; they are kept in memory.
constexpr std::uint64_t most_description = std::uint64_t{256} << 20;

/// What is there, by path below the root of the crate.
struct Found {
    std::map<std::string, FileSum> files;
    std::map<std::string, std::string> texts;   ///< of the two files that describe the others
    std::vector<std::string> defects;
    std::set<std::string> claimed_twice;   ///< paths of a file that another entry has, too: as a file or as a folder
    std::uint64_t bytes_of_texts = 0;
    std::string prefix;   ///< of the root in an archive: "", or "folder/"
};

bool describes(std::string_view name) {
    std::string_view const last = name.substr(name.rfind('/') + 1);
    return last == crate_file || last == sums_file;
}

/// For a line: what has control characters is shown as JSON would.
std::string shown(std::string const& name) {
    std::string all;
    for (char const c : name)
        all += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? fmt::format("\\x{:02x}", c) : std::string(1, c);
    return all;
}

// ---- an archive ----

std::string without_dots(std::string name) {
    while (name.starts_with("./")) name.erase(0, 2);
    return name;
}

void add_entry(ArchiveEntry const& entry, Found& found) {
    std::string const name = without_dots(entry.name);
    if (entry.kind == "directory") return;   // an empty one holds nothing that could be wrong
    if (!entry.is_file) {
        found.defects.push_back(fmt::format("{}: it is a {}, and only files are looked at", shown(name), entry.kind));
        return;
    }
    if (!is_safe_path(name)) {
        found.defects.push_back(fmt::format("{}: its name is no path in the archive", shown(name)));
        return;
    }
    Sha256 sum;
    std::uint64_t bytes = 0;
    std::string text;
    entry.read([&](std::span<std::byte const> piece) {
        sum.update(piece);
        bytes += piece.size();
        if (!describes(name)) return;
        found.bytes_of_texts += piece.size();
        if (found.bytes_of_texts > most_description)
            throw Error(fmt::format("cannot read {}", name), "it is too long", "Take a copy that is whole.");
        text.append(reinterpret_cast<char const*>(piece.data()), piece.size());
    });
    if (!found.files.emplace(name, FileSum{bytes, sum.text()}).second) {
        found.defects.push_back(fmt::format("{}: it is there twice", name));
        found.claimed_twice.insert(name);
    }
    if (describes(name)) found.texts[name] = std::move(text);
}

/// A file cannot lie beside a folder of its name.
void find_files_that_are_folders(Found& found) {
    std::set<std::string> folders;
    for (auto const& [name, sum] : found.files)
        for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1))
            folders.insert(name.substr(0, end));
    for (std::string const& name : folders) {
        if (!found.files.contains(name)) continue;
        found.defects.push_back(fmt::format("{}: it is a file and a folder", name));
        found.claimed_twice.insert(name);
    }
}

/// The folder of the crate's metadata that lies highest.
std::string prefix_of(Found const& found) {
    std::string prefix;
    bool known = false;
    for (auto const& [name, text] : found.texts) {
        if (!name.ends_with(crate_file)) continue;
        std::string const folder = name.substr(0, name.size() - crate_file.size());
        if (!known || folder.size() < prefix.size()) prefix = folder;
        known = true;
    }
    return prefix;
}

Found look_at_archive(std::string const& path, Pulse const& pulse) {
    Found all;
    for_each_entry(path, pulse, [&](ArchiveEntry const& entry) { add_entry(entry, all); });
    find_files_that_are_folders(all);
    Found found;
    found.defects = std::move(all.defects);
    found.prefix = prefix_of(all);
    for (auto& [name, sum] : all.files) {
        if (name.starts_with(found.prefix)) found.files.emplace(name.substr(found.prefix.size()), std::move(sum));
        else found.defects.push_back(fmt::format("{}: it lies outside of the crate", name));
    }
    for (std::string const& name : all.claimed_twice)
        if (name.starts_with(found.prefix)) found.claimed_twice.insert(name.substr(found.prefix.size()));
    for (auto& [name, text] : all.texts)
        if (name.starts_with(found.prefix)) found.texts[name.substr(found.prefix.size())] = std::move(text);
    return found;
}

// ---- a directory ----

Found look_at_directory(std::string const& path, Pulse const& pulse) {
    Found found;
    for (DirectoryEntry const& entry : entries_below(path)) {
        std::string const name = fs::path{entry.path}.lexically_relative(path).generic_string();
        if (is_transient(name)) continue;
        if (entry.type == fs::file_type::symlink)
            found.defects.push_back(fmt::format("{}: it is a link, and only files are looked at", name));
        else if (entry.type == fs::file_type::regular) {
            found.files.emplace(name, read_in_pieces(entry.path, pulse));
            if (name == crate_file || name == sums_file) found.texts[name] = read_text(entry.path, most_description);
        } else if (entry.type != fs::file_type::directory)
            found.defects.push_back(fmt::format("{}: it is a special file, and only files are looked at", name));
    }
    return found;
}

// ---- what is said against what is there ----

std::string difference(DescribedFile const& said, FileSum const& is) {
    if (said.bytes && *said.bytes != is.bytes)
        return fmt::format("{}: it has {} bytes, not {}", said.path, is.bytes, *said.bytes);
    if (!said.sha256.empty() && said.sha256 != is.sha256)
        return fmt::format("{}: its checksum is not the one described", said.path);
    if (said.sha256.empty() && said.path != sums_file)
        return fmt::format("{}: no checksum is described for it", said.path);
    return "";
}

void compare_with_crate(CrateDescription const& crate, Found const& found, std::vector<std::string>& defects) {
    std::set<std::string> known{std::string{crate_file}};
    for (DescribedFile const& said : crate.files) {
        if (!known.insert(said.path).second) continue;   // described twice, which is no harm
        auto const is = found.files.find(said.path);
        if (is == found.files.end()) {
            defects.push_back(fmt::format("{}: it is missing", said.path));
            continue;
        }
        if (std::string const line = difference(said, is->second); !line.empty()) defects.push_back(line);
    }
    for (DescribedFile const& said : crate.left_out)
        if (found.files.contains(said.path) && known.insert(said.path).second)
            defects.push_back(fmt::format("{}: it is described as left out, and is there", said.path));
    for (auto const& [path, sum] : found.files)
        if (!known.contains(path)) defects.push_back(fmt::format("{}: it is not described", path));
}

/// SHA256SUMS guards the crate's metadata, which cannot hold its own sum, and is guarded by what they say in turn.
void compare_with_sums(CrateDescription const& crate, Found const& found, std::vector<std::string>& defects) {
    auto const sums = found.texts.find(std::string{sums_file});
    if (sums == found.texts.end()) return;   // the crate misses it
    std::map<std::string, std::string> expected{
        {std::string{crate_file}, found.files.at(std::string{crate_file}).sha256}};
    for (DescribedFile const& said : crate.files)
        if (said.path != sums_file) expected[said.path] = said.sha256;
    int number = 0;
    for (std::string_view text = sums->second; !text.empty();) {
        std::size_t const end = std::min(text.find('\n'), text.size());
        std::string_view const line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
        constexpr std::size_t digits = 64;
        std::string const path{line.size() > digits + 2 ? line.substr(digits + 2) : ""};
        auto const is = expected.find(path);
        if (is == expected.end())
            defects.push_back(fmt::format("{}: line {} is of no file that is described", sums_file, number));
        else if (line.substr(0, digits + 2) != is->second + "  ")
            defects.push_back(fmt::format("{}: its checksum of {} is another", sums_file, path));
        if (is != expected.end()) expected.erase(is);
    }
    for (auto const& [path, sum] : expected)
        defects.push_back(fmt::format("{}: it has no line for {}", sums_file, path));
}

// ---- what Lore can read ----

/// Files that `lore-kb verify` knows.
bool is_of_lore(std::string_view path) {
    if (path.starts_with(inputs_folder) || path == crate_file) return false;
    std::string_view const name = path.substr(path.rfind('/') + 1);
    bool const of_run = path.starts_with("runs/");
    auto const ends = [&](std::string_view ending) { return name.ends_with(ending); };
    if (ends(".lore") || ends(".lorekb") || ends(".npy")) return true;
    if (of_run && (name == "config.toml" || name == "arena.toml")) return true;
    if (!ends(".csv") && !ends(".json")) return false;
    // Of what lies beside the report's tables nobody knows what its author holds for whole.
    constexpr std::array tables{"final.csv",  "runs.csv",   "curves.csv",  "population.csv", "kbs.csv",
                                "speed.csv",  "leads.csv",  "pvalues.csv", "pools.csv",      "matrix.csv",
                                "replay.csv", "values.csv", "scene.json",  "summary.json"};
    return of_run || path.starts_with("knowledge/") || path.starts_with("steps/") ||
           std::find(tables.begin(), tables.end(), path) != tables.end();
}

/// Of the system's directory for them; goes away with all that is in it.
class TemporaryDirectory {
public:
    TemporaryDirectory() {
        std::error_code failed;
        path_ = (fs::temp_directory_path(failed) / "lore-verify-XXXXXX").string();
        if (failed)
            throw Error("there is no directory for temporary files", failed.message(),
                        "Set TMPDIR to one that has room for what is in the archive.");
        if (::mkdtemp(path_.data()) == nullptr) throw file_error("write", path_, errno);
    }
    ~TemporaryDirectory() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryDirectory(TemporaryDirectory const&) = delete;
    TemporaryDirectory& operator=(TemporaryDirectory const&) = delete;
    std::string const& path() const { return path_; }

private:
    std::string path_;
};

/// Only names that were found to be safe, and nothing over what is there.
void unpack(std::string const& archive, std::string const& prefix, std::set<std::string> const& wanted,
            std::string const& into, Pulse const& pulse) {
    for_each_entry(archive, pulse, [&](ArchiveEntry const& entry) {
        std::string const name = without_dots(entry.name);
        if (!entry.is_file || !name.starts_with(prefix) || !wanted.contains(name.substr(prefix.size()))) return;
        std::string const path = (fs::path{into} / name.substr(prefix.size())).string();
        make_directory(fs::path{path}.parent_path().string());
        FileDescriptor file{::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600)};
        if (file.get() < 0) throw file_error("write", path, errno);
        entry.read([&](std::span<std::byte const> bytes) { write_fully(file.get(), bytes, path); });
        if (!file.close()) throw file_error("write", path, errno);
    });
}

/// A manifest does not miss what is left out, or is told of as a defect already.
void read_formats(std::string const& root, std::set<std::string> const& paths, CrateDescription const& crate,
                  Pulse const& pulse, std::vector<std::string>& defects) {
    std::string const start = root + "/";
    std::set<std::string> lacking;
    for (std::vector<DescribedFile> const* list : {&crate.left_out, &crate.files})
        for (DescribedFile const& file : *list)
            if (!paths.contains(file.path)) lacking.insert((fs::path{root} / file.path).string());
    for (std::string const& path : paths) {
        pulse();
        try {
            verify((fs::path{root} / path).string(), [&](std::string const& file) { return lacking.contains(file); });
        } catch (std::exception const& error) {
            std::string what = error.what();
            for (std::size_t at; (at = what.find(start)) != std::string::npos;) what.erase(at, start.size());
            defects.push_back(fmt::format("{}: {}", path, what));
        }
    }
}

/// Files of Lore that are there once and as they are described.
std::set<std::string> readable(CrateDescription const& crate, Found const& found) {
    std::set<std::string> paths;
    for (DescribedFile const& said : crate.files) {
        auto const is = found.files.find(said.path);
        if (is_of_lore(said.path) && !found.claimed_twice.contains(said.path) && is != found.files.end() &&
            difference(said, is->second).empty())
            paths.insert(said.path);
    }
    return paths;
}

}   // namespace

PackVerdict verify_pack(std::string const& path, Pulse const& pulse) {
    std::error_code ignored;   // what cannot be looked at is no archive either, which is told
    bool const is_directory = fs::is_directory(path, ignored);
    Found const found = is_directory ? look_at_directory(path, pulse) : look_at_archive(path, pulse);
    PackVerdict verdict;
    verdict.defects = found.defects;
    auto const text = found.texts.find(std::string{crate_file});
    if (text == found.texts.end()) {
        verdict.defects.push_back(fmt::format("{}: it is missing, and so nothing is described", crate_file));
        return verdict;
    }
    CrateDescription const crate = read_crate(text->second);
    verdict.title = crate.title;
    verdict.files = crate.files.size();
    verdict.left_out = crate.left_out.size();
    verdict.defects.insert(verdict.defects.end(), crate.defects.begin(), crate.defects.end());
    compare_with_crate(crate, found, verdict.defects);
    compare_with_sums(crate, found, verdict.defects);
    std::set<std::string> const paths = readable(crate, found);
    if (is_directory) {
        read_formats(path, paths, crate, pulse, verdict.defects);
    } else {
        TemporaryDirectory const place;
        unpack(path, found.prefix, paths, place.path(), pulse);
        read_formats(place.path(), paths, crate, pulse, verdict.defects);
    }
    return verdict;
}

}   // namespace lore
