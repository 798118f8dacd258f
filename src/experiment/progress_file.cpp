#include <lore/experiment/progress_file.h>

#include "progress_columns.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/core/input_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <span>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lore {

namespace {

[[noreturn]] void refuse(std::string const& path, std::string const& reason, std::string_view remedy) {
    throw Error(fmt::format("cannot read {}", path), reason, remedy);
}

/// A row has some 120 bytes.
constexpr std::uint64_t longest_tail = 2048;
constexpr std::uint64_t longest_header = 4096;

FileColumns columns_of(std::string_view header, std::string const& path) {
    auto columns = columns_named(header);
    if (!columns)
        refuse(path, "its columns are not those of progress.csv, or those of a newer Lore", "Check the path.");
    return *std::move(columns);
}

}   // namespace

std::string progress_header(std::string_view reward_unit) { return header_of(all_columns(), reward_unit); }

std::string text(GenerationSummary const& row) { return row_text(all_columns(), row); }

std::vector<GenerationSummary> read_progress(std::string const& path) {
    auto const bytes = read_file(path);
    std::string_view rest{reinterpret_cast<char const*>(bytes.data()), bytes.size()};
    FileColumns columns;
    std::vector<GenerationSummary> rows;
    for (int line_number = 1;; ++line_number) {
        std::size_t const end = rest.find('\n');
        if (end == std::string_view::npos) {
            if (line_number == 1) refuse(path, "there is no header", "Take a copy that is whole.");
            return rows;
        }
        std::string_view const line = rest.substr(0, end);
        rest.remove_prefix(end + 1);
        if (line_number == 1) {
            columns = columns_of(line, path);
            continue;
        }
        auto const row = row_from(columns, line);
        if (!row || row->generation != static_cast<int>(rows.size()))
            refuse(path, fmt::format("line {} is damaged", line_number), "Take a copy that is whole.");
        rows.push_back(*row);
    }
}

std::optional<GenerationSummary> read_last_progress(std::string const& path) {
    std::string start, tail;
    std::size_t header_bytes = 0;
    try {
        InputFile const file = open_regular(path);
        start = first_bytes(file, longest_header);
        header_bytes = start.find('\n') + 1;   // npos + 1 is 0
        tail = last_bytes(file, std::min<std::uint64_t>(file.size - header_bytes, longest_tail));
    } catch (Error const&) { return std::nullopt; }
    if (header_bytes == 0) return std::nullopt;
    std::string_view const header = std::string_view{start}.substr(0, header_bytes - 1);
    auto const columns = columns_named(header, progress_columns(), 0);   // a look at whatever is there
    std::size_t const end = tail.rfind('\n');
    if (!columns || end == std::string::npos || end == 0) return std::nullopt;
    std::size_t const begin = tail.rfind('\n', end - 1) + 1;   // npos + 1 is 0
    return row_from(*columns, std::string_view{tail}.substr(begin, end - begin));
}

ProgressWriter::ProgressWriter(std::string path, std::uint64_t bytes, std::string_view reward_unit)
    : path_(std::move(path)) {
    bool const fresh = bytes == 0;
    if (!fresh) {
        struct stat status {};
        if (::stat(path_.c_str(), &status) != 0 || static_cast<std::uint64_t>(status.st_size) < bytes)
            throw Error(fmt::format("cannot go on with {}", path_),
                        fmt::format("it is shorter than the {} bytes that the checkpoint knows", bytes),
                        "Take a copy that is whole, or start the run anew in another directory.");
    }
    file_ = FileDescriptor{::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (fresh ? O_TRUNC : 0), 0666)};
    if (file_.get() < 0) throw file_error("write", path_, errno);
    if (!fresh && (::ftruncate(file_.get(), static_cast<off_t>(bytes)) != 0 || ::lseek(file_.get(), 0, SEEK_END) < 0))
        throw file_error("write", path_, errno);
    bytes_ = bytes;
    if (fresh) {
        columns_ = all_columns();
        write(header_of(columns_, reward_unit) + "\n");
    } else {
        std::string const start = first_bytes(open_regular(path_), longest_header);
        columns_ = columns_of(std::string_view{start}.substr(0, start.find('\n')), path_);
    }
}

void ProgressWriter::write(std::string_view line) {
    write_fully(file_.get(), std::as_bytes(std::span{line}), path_);
    bytes_ += line.size();
}

void ProgressWriter::add(GenerationSummary const& row) { write(row_text(columns_, row) + "\n"); }

std::uint64_t ProgressWriter::sync() {
    sync_file(file_.get(), path_);
    return bytes_;
}

}   // namespace lore
