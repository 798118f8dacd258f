#include <lore/archive/founders_file.h>

#include "archive/random_population.h"
#include "support/scratch.h"

#include <lore/core/error.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <string_view>

using namespace lore;
using ::testing::HasSubstr;

namespace {

FoundersFile sample() {
    FoundersFile founders{"clones of a knowledge base", R"({"base":"kb.lorekb","seed":1})", {}};
    for (Individual const& member : evolved(20).population.members) founders.genomes.push_back(member.birth->genome);
    return founders;
}

}   // namespace

TEST(FoundersFile, gives_back_genomes_and_origin) {
    Scratch const scratch;
    FoundersFile const founders = sample();
    write_founders(scratch.file("f.lore"), founders);
    FoundersFile const back = read_founders(scratch.file("f.lore"));
    EXPECT_EQ(back.kind, founders.kind);
    EXPECT_THAT(back.origin, HasSubstr("\"base\": \"kb.lorekb\""));
    EXPECT_EQ(back.genomes, founders.genomes);
    EXPECT_EQ(kind_of_file(scratch.file("f.lore")), FileKind::founders);
}

TEST(FoundersFile, of_another_interface_is_refused_as_the_user_s_mistake) {
    Scratch const scratch;
    write_founders(scratch.file("f.lore"), sample());
    Bytes const payload = read_container(scratch.file("f.lore"), FileKind::founders);
    for (std::string_view const channel : {"bumper_left", "collect"}) {
        Bytes other = payload;
        auto const letter = [](std::byte a, char b) { return a == static_cast<std::byte>(b); };
        auto const at = std::search(other.begin(), other.end(), channel.begin(), channel.end(), letter);
        ASSERT_NE(at, other.end());
        *at = std::byte{'x'};
        try {
            unpack_founders(other, "f.lore");
            ADD_FAILURE() << channel;
        } catch (UsageError const& error) { EXPECT_THAT(error.what(), HasSubstr("f.lore does not fit the robot")); }
    }
}

TEST(FoundersFile, cut_or_without_genomes_is_refused) {
    Scratch const scratch;
    write_founders(scratch.file("f.lore"), sample());
    Bytes const payload = read_container(scratch.file("f.lore"), FileKind::founders);
    for (std::size_t length = 0; length < payload.size(); length += length < 300 ? 1 : 97)
        EXPECT_THROW(unpack_founders(std::span{payload}.first(length), "x"), Error) << length;
    write_founders(scratch.file("none.lore"), {"none", "{}", {}});
    EXPECT_THROW(read_founders(scratch.file("none.lore")), Error);
}
