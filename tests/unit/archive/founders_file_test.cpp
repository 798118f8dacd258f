#include <lore/archive/founders_file.h>

#include "archive/random_population.h"
#include "support/complaint.h"
#include "support/scratch.h"

#include <lore/core/error.h>

#include <gmock/gmock.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

FoundersFile sample() {
    FoundersFile founders{"clones of a knowledge base", R"({"base":"kb.lorekb","seed":1})", {}, test::robots_world()};
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
    EXPECT_EQ(back.world, founders.world);
    EXPECT_EQ(kind_of_file(scratch.file("f.lore")), FileKind::founders);
}

TEST(FoundersFile, may_know_no_more_of_its_world_than_the_channels) {
    Scratch const scratch;
    FoundersFile founders{"clones of a knowledge base", "{}", {}, {}};
    founders.world.channels = test::toys_world().channels;
    founders.genomes.push_back(founder(founders.world.interface(), Stream{1, Purpose::founder}));
    write_founders(scratch.file("f.lore"), founders);
    FoundersFile const back = read_founders(scratch.file("f.lore"));
    EXPECT_EQ(back.genomes, founders.genomes);
    EXPECT_EQ(back.world, founders.world);
}

TEST(FoundersFile, cut_or_without_genomes_is_refused) {
    Scratch const scratch;
    write_founders(scratch.file("f.lore"), sample());
    Bytes const payload = read_container(scratch.file("f.lore"), FileKind::founders).bytes;
    for (std::size_t length = 0; length < payload.size(); length += length < 300 ? 1 : 97)
        EXPECT_THROW(
            unpack_founders({Bytes(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(length))}, "x"),
            Error)
            << length;
    write_founders(scratch.file("none.lore"), {"none", "{}", {}, test::robots_world()});
    EXPECT_THROW(read_founders(scratch.file("none.lore")), Error);
}
