#include "support/scratch.h"

#include <lore/core/growing_bytes.h>

#include <gmock/gmock.h>

#include <csignal>
#include <cstring>
#include <filesystem>

#include <sys/resource.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

/// Records of four numbers, of which the first is the record's.
void add(GrowingBytes& bytes, std::uint32_t first, std::uint32_t records) {
    for (std::uint32_t i = first; i < first + records; ++i) {
        std::uint32_t const record[4]{i, i * 3, i * 5, i * 7};
        bytes.add(std::as_bytes(std::span{record}));
    }
}

void expect_record(GrowingBytes const& bytes, std::uint32_t number) {
    std::byte copy[16];
    std::uint32_t record[4];
    std::memcpy(record, bytes.read(number * std::uint64_t{16}, 16, copy), sizeof record);
    ASSERT_EQ(record[0], number);
    ASSERT_EQ(record[3], number * 7);
}

/// More than one is written at once.
constexpr std::uint32_t many = 200'000;

void expect_all(GrowingBytes& bytes) {
    add(bytes, 0, many);
    EXPECT_EQ(bytes.size(), many * std::uint64_t{16});
    for (std::uint32_t number : {0u, 1u, 65'535u, 65'536u, 131'071u, many - 2, many - 1}) expect_record(bytes, number);
    add(bytes, many, 1);
    expect_record(bytes, many);
    expect_record(bytes, 17);
    GrowingBytes::Whole const whole = bytes.release();
    ASSERT_EQ(whole.bytes.size(), (many + 1) * std::size_t{16});
    for (std::uint32_t number = 0; number <= many; ++number) {
        std::uint32_t first;
        std::memcpy(&first, whole.bytes.data() + std::size_t{number} * 16, sizeof first);
        ASSERT_EQ(first, number);
    }
}

}   // namespace

TEST(GrowingBytes, are_read_as_they_were_added_in_memory) {
    GrowingBytes bytes;
    expect_all(bytes);
}

TEST(GrowingBytes, are_read_as_they_were_added_to_a_file_without_a_name) {
    Scratch const scratch;
    GrowingBytes bytes{scratch.path()};
    expect_all(bytes);
    EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST(GrowingBytes, outlive_what_they_were_added_to) {
    Scratch const scratch;
    GrowingBytes::Whole whole;
    {
        GrowingBytes bytes{scratch.path()};
        add(bytes, 0, 10);
        whole = bytes.release();
    }
    EXPECT_EQ(static_cast<int>(whole.bytes[16]), 1);
}

TEST(GrowingBytes, may_be_none) {
    Scratch const scratch;
    EXPECT_TRUE(GrowingBytes{}.release().bytes.empty());
    EXPECT_TRUE(GrowingBytes{scratch.path()}.release().bytes.empty());
}

TEST(GrowingBytes, say_where_they_cannot_be_written) {
    try {
        GrowingBytes{"/no/such/folder"};
        FAIL() << "a folder that is not there was taken";
    } catch (Error const& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("cannot make a file without a name in /no/such/folder (No such file or directory)"));
    }
    Scratch const scratch;
    GrowingBytes bytes{scratch.path()};
    auto const former_action = std::signal(SIGXFSZ, SIG_IGN);
    rlimit former;
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &former), 0);
    rlimit const tight{100'000, former.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
    std::string what;
    try {
        add(bytes, 0, many);
    } catch (Error const& error) { what = error.what(); }
    ::setrlimit(RLIMIT_FSIZE, &former);
    std::signal(SIGXFSZ, former_action);
    EXPECT_THAT(what, HasSubstr("cannot write a file without a name in " + scratch.path() + " (File too large)"));
}
