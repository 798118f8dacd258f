#include <lore/archive/atomic_file.h>

#include "support/complaint.h"
#include "support/scratch.h"

#include <lore/core/error.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <numeric>
#include <utility>

#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

std::string text(std::string const& path) {
    auto const bytes = read_file(path);
    return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

std::string failure_of_writing(std::string const& path, std::string_view content) {
    return test::complaint_of([&] { write_file_atomically(path, content); });
}

int entries(std::string const& directory) {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator{directory}, {}));
}

}   // namespace

TEST(AtomicFile, replaces_a_former_file_and_leaves_nothing_else) {
    Scratch const scratch;
    write_file_atomically(scratch.file("a"), "first");
    write_file_atomically(scratch.file("a"), "second");
    EXPECT_EQ(text(scratch.file("a")), "second");
    EXPECT_EQ(entries(scratch.path()), 1);
}

TEST(AtomicFile, is_whole_when_it_is_so_large_that_it_is_written_in_parts) {
    Scratch const scratch;
    std::vector<std::uint32_t> numbers((std::size_t{40} << 20) / sizeof(std::uint32_t));
    std::iota(numbers.begin(), numbers.end(), 0u);
    auto const large = std::as_bytes(std::span{std::as_const(numbers)}), small = large.first(3);
    std::vector<std::span<std::byte const>> const pieces{small, large, small};
    write_file_atomically(scratch.file("a"), BytePieces{pieces});
    auto const written = read_file(scratch.file("a"));
    ASSERT_EQ(written.size(), large.size() + 6);
    std::span const bytes{written};
    EXPECT_TRUE(std::ranges::equal(bytes.first(3), small));
    EXPECT_TRUE(std::ranges::equal(bytes.subspan(3, large.size()), large));
    EXPECT_TRUE(std::ranges::equal(bytes.last(3), small));
}

TEST(AtomicFile, takes_the_place_of_no_pipe_and_of_no_link) {
    Scratch const scratch;
    std::string const pipe = scratch.file("pipe"), link = scratch.file("link"), file = scratch.file("file");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(failure_of_writing(pipe, "x"), HasSubstr("it is a pipe or a device"));
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    write_file_atomically(file, "former");
    std::filesystem::create_symlink("file", link);
    write_file_atomically(link, "present");
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(text(file), "present");
}

TEST(AtomicFile, keeps_the_former_file_when_the_size_limit_strikes) {
    Scratch const scratch;
    write_file_atomically(scratch.file("a"), "former");
    auto const handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit former{};
    getrlimit(RLIMIT_FSIZE, &former);
    rlimit const tight{4096, former.rlim_max};
    setrlimit(RLIMIT_FSIZE, &tight);
    std::string const failure = failure_of_writing(scratch.file("a"), std::string(10000, 'x'));
    setrlimit(RLIMIT_FSIZE, &former);
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(failure, HasSubstr("File too large"));
    EXPECT_EQ(text(scratch.file("a")), "former");
    EXPECT_EQ(entries(scratch.path()), 1);
}

TEST(AtomicFile, keeps_the_former_file_when_the_disk_is_full) {
    Scratch const scratch;
    if (::mount("tmpfs", scratch.path().c_str(), "tmpfs", 0, "size=64k") != 0)
        GTEST_SKIP() << "no right to mount a tmpfs here";
    write_file_atomically(scratch.file("a"), "former");
    std::string const failure = failure_of_writing(scratch.file("a"), std::string(200000, 'x'));
    EXPECT_THAT(failure, HasSubstr("No space left on device"));
    EXPECT_EQ(text(scratch.file("a")), "former");
    EXPECT_EQ(entries(scratch.path()), 1);
    ::umount(scratch.path().c_str());
}

TEST(AtomicFile, reports_a_directory_that_cannot_be_written_or_is_gone) {
    Scratch const scratch;
    EXPECT_EQ(failure_of_writing(scratch.file("gone/a"), "x"),
              "cannot write " + scratch.file("gone/a") + " (No such file or directory). Check the path.");
    if (::geteuid() == 0) GTEST_SKIP() << "root may write to a read-only directory";
    ::chmod(scratch.path().c_str(), 0500);
    EXPECT_THAT(failure_of_writing(scratch.file("a"), "x"), HasSubstr("Permission denied"));
    ::chmod(scratch.path().c_str(), 0700);
}

TEST(AtomicFile, removes_what_a_killed_writer_left) {
    Scratch const scratch;
    write_file_atomically(scratch.file("a"), "x");
    write_file_atomically(scratch.file("a.lore-tmp-123"), "half");
    remove_leftovers(scratch.path());
    EXPECT_EQ(entries(scratch.path()), 1);
}

TEST(ReadFile, reads_files_of_unstated_length_and_refuses_directories) {
    EXPECT_FALSE(read_file("/proc/self/status").empty());
    Scratch const scratch;
    EXPECT_THROW(read_file(scratch.path()), Error);
    EXPECT_THROW(read_file(scratch.file("missing")), Error);
}
