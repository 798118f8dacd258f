#include <lore/core/input_file.h>

#include "support/scratch.h"

#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

void write(std::string const& path, std::string const& text) { std::ofstream{path, std::ios::binary} << text; }

struct Refusal {
    ExitCode code = ExitCode::done;
    std::string line;
};

Refusal refusal(std::string const& path, std::uint64_t limit = most_text) {
    try {
        read_text(path, limit);
    } catch (Error const& error) { return {error.exit_code(), error.what()}; }
    return {};
}

/// A pipe of that name into which a thread writes after a while; `pause` lies between its two pieces.
class Writer {
public:
    Writer(std::string const& path, std::chrono::milliseconds before, std::chrono::milliseconds pause) {
        ::mkfifo(path.c_str(), 0600);
        thread_ = std::thread{[=] {
            std::this_thread::sleep_for(before);
            int const pipe = ::open(path.c_str(), O_WRONLY);
            [[maybe_unused]] auto written = ::write(pipe, "first ", 6);
            std::this_thread::sleep_for(pause);
            written = ::write(pipe, "second", 6);
            ::close(pipe);
        }};
    }
    ~Writer() { thread_.join(); }

private:
    std::thread thread_;
};

}   // namespace

TEST(InputFile, is_read_whole_whether_it_knows_its_length_or_not) {
    Scratch const scratch;
    write(scratch.file("a"), "text");
    EXPECT_EQ(read_text(scratch.file("a")), "text");
    write(scratch.file("empty"), "");
    EXPECT_EQ(read_text(scratch.file("empty")), "");
    EXPECT_EQ(read_text("/dev/null"), "");
    EXPECT_THAT(read_text("/proc/self/status"), HasSubstr("Name:"));
    write(scratch.file("long"), std::string(100000, 'x'));
    EXPECT_EQ(read_bytes(scratch.file("long")).size(), 100000u);
}

TEST(InputFile, of_a_wrong_name_is_an_error_of_usage) {
    Scratch const scratch;
    write(scratch.file("file"), "");
    EXPECT_EQ(refusal(scratch.file("missing")).line,
              "cannot read " + scratch.file("missing") + " (No such file or directory). Check the path.");
    EXPECT_THROW(read_text(scratch.path()), UsageError);
    for (std::string const& name : {scratch.file("missing"), scratch.path(), scratch.file("file/below"),
                                    scratch.file(std::string(300, 'x')), std::string{}})
        EXPECT_EQ(refusal(name).code, ExitCode::usage) << name;
    int const listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{AF_UNIX, "socket"};
    std::filesystem::path const before = std::filesystem::current_path();
    std::filesystem::current_path(scratch.path());   // a socket's name is short
    ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr const*>(&address), sizeof address), 0);
    EXPECT_EQ(refusal("socket").code, ExitCode::usage);
    std::filesystem::current_path(before);
    ::close(listener);
}

TEST(InputFile, without_an_end_is_given_up_at_the_limit) {
    Scratch const scratch;
    EXPECT_THAT(refusal("/dev/zero").line, HasSubstr("more than the 16777216 bytes"));
    EXPECT_EQ(refusal("/dev/zero").code, ExitCode::usage);
    write(scratch.file("ten"), "0123456789");
    EXPECT_EQ(refusal(scratch.file("ten"), 10).line, "");
    EXPECT_THAT(refusal(scratch.file("ten"), 9).line, HasSubstr("more than the 9 bytes"));
}

TEST(InputFile, may_be_a_pipe_whose_writer_comes_late_and_pauses) {
    using std::chrono::milliseconds;
    Scratch const scratch;
    Writer const writer{scratch.file("pipe"), milliseconds{100}, milliseconds{100}};
    EXPECT_EQ(read_text(scratch.file("pipe")), "first second");
}

TEST(InputFile, may_be_a_pipe_that_was_written_and_closed_before) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_EQ(::write(ends[1], "text", 4), 4);
    ::close(ends[1]);
    EXPECT_EQ(read_text("/dev/fd/" + std::to_string(ends[0])), "text");
    ::close(ends[0]);
    ASSERT_EQ(::pipe(ends), 0);
    ::close(ends[1]);
    EXPECT_EQ(read_text("/dev/fd/" + std::to_string(ends[0])), "");
    ::close(ends[0]);
}

TEST(InputFile, that_is_a_pipe_without_a_writer_is_given_up_after_seconds) {
    Scratch const scratch;
    ASSERT_EQ(::mkfifo(scratch.file("pipe").c_str(), 0600), 0);
    auto const began = std::chrono::steady_clock::now();
    Refusal const said = refusal(scratch.file("pipe"));
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds{20});
    EXPECT_EQ(said.code, ExitCode::usage);
    EXPECT_EQ(said.line, "cannot read " + scratch.file("pipe") +
                             " (nothing was written into this pipe for 5 s). Start what writes into it, or save that "
                             "to a file first.");
}

TEST(InputFile, that_is_to_be_read_twice_is_no_pipe) {
    Scratch const scratch;
    ASSERT_EQ(::mkfifo(scratch.file("pipe").c_str(), 0600), 0);
    EXPECT_THROW(open_regular(scratch.file("pipe")), UsageError);
    EXPECT_THROW(open_regular("/dev/null"), UsageError);
    write(scratch.file("file"), "text");
    EXPECT_EQ(open_regular(scratch.file("file")).size, 4u);
}

TEST(InputFile, gives_its_first_and_last_bytes_or_all_it_has) {
    Scratch const scratch;
    write(scratch.file("ten"), "0123456789");
    InputFile const ten = open_regular(scratch.file("ten"));
    EXPECT_EQ(first_bytes(ten, 3), "012");
    EXPECT_EQ(last_bytes(ten, 3), "789");
    EXPECT_EQ(first_bytes(ten, 11), "0123456789");
    EXPECT_EQ(last_bytes(ten, 11), "0123456789");
    EXPECT_EQ(last_bytes(ten, 0), "");
}
