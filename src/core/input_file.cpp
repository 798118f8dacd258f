#include <lore/core/input_file.h>

#include <lore/core/installation.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lore {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds patience_for_a_writer{5000};
constexpr milliseconds longest_silence{60000};
constexpr std::size_t first_piece = 4096;   ///< the first read of a stream

/// A UsageError where another name would have been right; everything else is the system's failure.
[[noreturn]] void fail_to_open(std::string const& path, int error_number) {
    auto const refusal = [&](std::string_view remedy) {
        return UsageError(fmt::format("cannot read {}", path), std::strerror(error_number), remedy);
    };
    switch (error_number) {
    case ENOENT: throw refusal(remedy_for_missing(path));
    case EISDIR: throw refusal("Name a file in it.");
    case ENOTDIR:
    case ELOOP:
    case ENAMETOOLONG: throw refusal("Check the path.");
    case EACCES:
    case EPERM: throw refusal("Change its permissions.");
    case ENXIO: throw refusal("A socket is no file; name one.");
    default: throw file_error("read", path, error_number);
    }
}

/// False after that time without a byte and without an end.
bool has_something(int descriptor, milliseconds patience) {
    auto const end = std::chrono::steady_clock::now() + patience;
    while (true) {
        auto const left = std::chrono::ceil<milliseconds>(end - std::chrono::steady_clock::now());
        pollfd asked{descriptor, POLLIN, 0};
        int const ready = ::poll(&asked, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
        if (ready >= 0 || errno != EINTR) return ready != 0;   // where poll fails, read says why
    }
}

[[noreturn]] void refuse_silence(std::string const& path, milliseconds patience) {
    throw UsageError(fmt::format("cannot read {}", path),
                     fmt::format("nothing was written into this pipe for {} s", patience.count() / 1000),
                     "Start what writes into it, or save that to a file first.");
}

/// What one read gives: bytes, or 0 at the end. Waits, since streams are opened without blocking.
std::size_t read_piece(InputFile const& file, std::byte* into, std::size_t room) {
    while (true) {
        ssize_t const got = ::read(file.descriptor.get(), into, room);
        if (got >= 0) return static_cast<std::size_t>(got);
        if (errno == EAGAIN) {
            if (!has_something(file.descriptor.get(), longest_silence)) refuse_silence(file.path, longest_silence);
        } else if (errno != EINTR) {
            throw file_error("read", file.path, errno);
        }
    }
}

template <class Buffer>
Buffer read_whole(InputFile const& file, std::uint64_t limit) {
    auto const refuse = [&](std::uint64_t most) {
        throw UsageError(fmt::format("cannot read {}", file.path),
                         fmt::format("it has more than the {} bytes that such a file may have", most),
                         file.regular ? "Check the path." : "Check the path, or save it to a file first.");
    };
    if (!file.regular) limit = std::min(limit, most_of_stream);
    if (file.size > limit) refuse(limit);
    // Before its first writer a pipe seems to be at its end.
    bool const no_writer = !file.regular && !has_something(file.descriptor.get(), patience_for_a_writer);
    Buffer content;
    content.resize(static_cast<std::size_t>(file.size) + 1);   // one more, to see the end
    std::size_t filled = 0;
    while (true) {
        if (filled == content.size()) content.resize(std::max(first_piece, content.size() * 2));
        std::size_t const got =
            read_piece(file, reinterpret_cast<std::byte*>(content.data()) + filled, content.size() - filled);
        if (got == 0 && filled == 0 && no_writer) refuse_silence(file.path, patience_for_a_writer);
        if (got == 0) break;
        filled += got;
        if (filled > limit) refuse(limit);
    }
    content.resize(filled);
    return content;
}

std::string bytes_from(InputFile const& file, std::uint64_t start, std::uint64_t count) {
    assert(file.regular);
    std::string bytes(static_cast<std::size_t>(count), '\0');
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        ssize_t const got = ::pread(file.descriptor.get(), bytes.data() + filled, bytes.size() - filled,
                                    static_cast<off_t>(start + filled));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw file_error("read", file.path, errno);
        if (got == 0) break;   // cut meanwhile
        filled += static_cast<std::size_t>(got);
    }
    bytes.resize(filled);
    return bytes;
}

}   // namespace

InputFile open_input(std::string const& path) {
    // Without O_NONBLOCK, opening a pipe waits for its writer.
    InputFile file{path, FileDescriptor{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)}};
    if (file.descriptor.get() < 0) fail_to_open(path, errno);
    struct stat status {};
    if (::fstat(file.descriptor.get(), &status) != 0) throw file_error("read", path, errno);
    if (S_ISDIR(status.st_mode)) fail_to_open(path, EISDIR);
    file.regular = S_ISREG(status.st_mode);
    if (file.regular) file.size = static_cast<std::uint64_t>(status.st_size);
    return file;
}

InputFile open_regular(std::string const& path) {
    InputFile file = open_input(path);
    if (!file.regular)
        throw UsageError(fmt::format("cannot read {}", path), "it is a pipe or a device, and is read more than once",
                         "Save it to a file first.");
    return file;
}

std::vector<std::byte> read_bytes(InputFile const& file, std::uint64_t limit) {
    return read_whole<std::vector<std::byte>>(file, limit);
}

std::vector<std::byte> read_bytes(std::string const& path, std::uint64_t limit) {
    return read_bytes(open_input(path), limit);
}

std::string read_text(std::string const& path, std::uint64_t limit) {
    return read_whole<std::string>(open_input(path), limit);
}

std::string first_bytes(InputFile const& file, std::uint64_t bytes) {
    return bytes_from(file, 0, std::min(bytes, file.size));
}

std::string last_bytes(InputFile const& file, std::uint64_t bytes) {
    std::uint64_t const count = std::min(bytes, file.size);
    return bytes_from(file, file.size - count, count);
}

}   // namespace lore
