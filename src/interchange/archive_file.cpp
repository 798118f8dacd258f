#include "archive_file.h"

#include "new_directory.h"

#include <lore/core/error.h>
#include <lore/core/input_file.h>

#include <cerrno>
#include <clocale>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

/// 1980-01-01, the first day that zip knows [s since 1970].
constexpr std::time_t time_of_all = 315'532'800;

using WritingArchive = std::unique_ptr<struct archive, decltype(&archive_write_free)>;
using ReadingArchive = std::unique_ptr<struct archive, decltype(&archive_read_free)>;
using Entry = std::unique_ptr<archive_entry, decltype(&archive_entry_free)>;

/// libarchive translates names by the locale, and writes local times into zip.
void use_one_locale() {
    std::setlocale(LC_CTYPE, "C.UTF-8");
    ::setenv("TZ", "UTC0", 1);
    ::tzset();
}

std::string reason_of(struct archive* archive) {
    char const* const text = archive_error_string(archive);
    return text == nullptr ? "no reason is known" : text;
}

Error unreadable(std::string const& path, struct archive* archive) {
    return Error(fmt::format("cannot read {}", path), reason_of(archive), "Take a copy that is whole.");
}

void expect(int code, std::string const& path, struct archive* archive) {
    if (code == ARCHIVE_OK) return;
    throw Error(fmt::format("cannot write {}", path), reason_of(archive), "Free some space, or choose another place.");
}

void choose_format(std::string const& path, struct archive* archive) {
    if (path.ends_with(".zip")) {
        expect(archive_write_set_format_zip(archive), path, archive);
        return;
    }
    expect(archive_write_set_format_pax_restricted(archive), path, archive);
    if (path.ends_with(".tar.zst")) {
        expect(archive_write_add_filter_zstd(archive), path, archive);
        expect(archive_write_set_filter_option(archive, "zstd", "compression-level", "9"), path, archive);
    } else {
        expect(archive_write_add_filter_gzip(archive), path, archive);
        expect(archive_write_set_filter_option(archive, "gzip", "timestamp", nullptr), path, archive);
    }
}

ArchiveEntry described(archive_entry* entry) {
    char const* const name = archive_entry_pathname_utf8(entry);
    ArchiveEntry found;
    found.name = name == nullptr ? "" : name;
    bool const link = archive_entry_hardlink(entry) != nullptr || archive_entry_filetype(entry) == AE_IFLNK;
    found.is_file = !link && archive_entry_filetype(entry) == AE_IFREG;
    found.kind = link                                        ? "link"
                 : found.is_file                             ? "file"
                 : archive_entry_filetype(entry) == AE_IFDIR ? "directory"
                                                             : "special file";
    return found;
}

}   // namespace

struct ArchiveWriter::State {
    std::string path, temporary;
    FileDescriptor file;
    WritingArchive archive{archive_write_new(), &archive_write_free};
    bool kept = false;
    ~State() {
        archive.reset();   // it may still write
        if (!kept) ::unlink(temporary.c_str());
    }
};

bool is_archive_name(std::string const& path) {
    return path.ends_with(".tar.zst") || path.ends_with(".tar.gz") || path.ends_with(".zip");
}

ArchiveWriter::ArchiveWriter(std::string path) : state_(std::make_unique<State>()) {
    if (!is_archive_name(path))
        throw UsageError(fmt::format("cannot write {}", path), "its name does not end with .tar.zst, .tar.gz or .zip",
                         "Give it one of these endings.");
    if (fs::symlink_status(path).type() != fs::file_type::not_found)
        throw UsageError(fmt::format("cannot write {}", path), "it exists", "Choose another name, or move it away.");
    use_one_locale();
    state_->path = path;
    state_->temporary = fmt::format("{}.lore-tmp-{}", path, ::getpid());
    state_->file = FileDescriptor{::open(state_->temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
    if (state_->file.get() < 0) throw file_error("write", path, errno);
    struct archive* const archive = state_->archive.get();
    choose_format(path, archive);
    expect(archive_write_set_bytes_in_last_block(archive, 1), path, archive);   // no padding after the end
    expect(archive_write_open_fd(archive, state_->file.get()), path, archive);
}

ArchiveWriter::~ArchiveWriter() = default;

void ArchiveWriter::begin(std::string const& name, std::uint64_t bytes, bool executable) {
    Entry const entry{archive_entry_new(), &archive_entry_free};
    archive_entry_set_pathname_utf8(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), executable ? 0755 : 0644);
    archive_entry_set_mtime(entry.get(), time_of_all, 0);
    expect(archive_write_header(state_->archive.get(), entry.get()), state_->path, state_->archive.get());
}

void ArchiveWriter::write(std::span<std::byte const> bytes) {
    while (!bytes.empty()) {
        la_ssize_t const written = archive_write_data(state_->archive.get(), bytes.data(), bytes.size());
        if (written <= 0) expect(ARCHIVE_FATAL, state_->path, state_->archive.get());
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void ArchiveWriter::close() {
    expect(archive_write_close(state_->archive.get()), state_->path, state_->archive.get());
    sync_file(state_->file.get(), state_->path);
    if (!state_->file.close()) throw file_error("write", state_->path, errno);
    rename_without_replacing(state_->temporary, state_->path);
    state_->kept = true;
}

void for_each_entry(std::string const& path, BetweenPieces const& between,
                    std::function<void(ArchiveEntry const&)> const& look) {
    use_one_locale();
    InputFile const file = open_regular(path);
    ReadingArchive const reading{archive_read_new(), &archive_read_free};
    struct archive* const archive = reading.get();
    // By name, not all that there are: some would start programs.
    archive_read_support_filter_zstd(archive);
    archive_read_support_filter_gzip(archive);
    archive_read_support_filter_xz(archive);
    archive_read_support_filter_bzip2(archive);
    archive_read_support_format_tar(archive);
    archive_read_support_format_zip(archive);
    constexpr std::size_t block = std::size_t{1} << 16;
    if (archive_read_open_fd(archive, file.descriptor.get(), block) != ARCHIVE_OK) throw unreadable(path, archive);
    while (true) {
        between();
        archive_entry* entry = nullptr;
        int const code = archive_read_next_header(archive, &entry);
        if (code == ARCHIVE_EOF) return;
        if (code != ARCHIVE_OK && code != ARCHIVE_WARN) throw unreadable(path, archive);
        ArchiveEntry found = described(entry);
        found.read = [&](auto const& use) {
            void const* data = nullptr;
            std::size_t bytes = 0;
            la_int64_t offset = 0, expected = 0;
            int status = ARCHIVE_OK;
            while ((status = archive_read_data_block(archive, &data, &bytes, &offset)) == ARCHIVE_OK) {
                between();
                // A sparse file has holes, and what Lore writes has none.
                if (offset != expected)
                    throw Error(fmt::format("cannot read {}", path), fmt::format("{} has holes", found.name),
                                "Pack it again without them.");
                use(std::span{static_cast<std::byte const*>(data), bytes});
                expected += static_cast<la_int64_t>(bytes);
            }
            if (status != ARCHIVE_EOF) throw unreadable(path, archive);
        };
        look(found);
    }
}

}   // namespace lore
