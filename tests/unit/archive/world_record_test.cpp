#include <lore/archive/world_record.h>

#include "archive/random_population.h"

#include <gmock/gmock.h>

#include <stdexcept>

using namespace lore;
using ::testing::HasSubstr;

TEST(WorldRecord, is_read_back_from_its_text) {
    for (WorldRecord const& record : {test::robots_world(), test::toys_world(), WorldRecord{}})
        EXPECT_EQ(parse_world_record(to_json(record)), record);
}

TEST(WorldRecord, of_a_library_has_the_file_s_name_without_its_folder_its_checksum_and_its_settings) {
    WorldRecord const record = test::toys_world();
    EXPECT_EQ(record.file, "toy.so");
    EXPECT_THAT(to_json(record), HasSubstr("\"xxh3_64\": \"0123456789abcdef\""));
    EXPECT_EQ(record.settings, "length = 2\n");
    EXPECT_THAT(to_json(test::robots_world()), Not(HasSubstr("xxh3_64")));
}

TEST(WorldRecord, that_is_none_is_refused) {
    for (char const* text : {"", "[]", "{}", R"({"sensors": ["a"], "effectors": ["b"]})",
                             R"({"sensors": ["a"], "effectors": ["b"], "binary": ["c"]})",
                             R"({"sensors": ["a"], "effectors": ["a"], "binary": []})",
                             R"({"sensors": ["a"], "effectors": ["b"], "binary": [], "outcome_size": 1.5})",
                             R"({"sensors": ["a"], "effectors": ["b"], "binary": [], "outcome_size": 257})",
                             R"({"sensors": ["a"], "effectors": ["b"], "binary": [], "width": -1})",
                             R"({"sensors": ["a"], "effectors": ["b"], "binary": [], "width": 1e300})",
                             R"({"sensors": ["a"], "effectors": ["b"], "binary": [], "xxh3_64": "12"})",
                             R"({"sensors": ["A b"], "effectors": ["b"], "binary": []})",
                             R"({"sensors": 3, "effectors": 4, "binary": 5})"})
        EXPECT_THROW(parse_world_record(text), std::out_of_range) << text;
}

TEST(WhyOther, tells_in_one_phrase_what_differs) {
    WorldRecord const present = test::toys_world();
    EXPECT_EQ(why_other(present, present), "");
    auto const with = [&](auto const& change) {
        WorldRecord stored = present;
        change(stored);
        return why_other(stored, present);
    };
    EXPECT_EQ(with([](WorldRecord& r) { r.name = "maze"; }), "made in world maze, not in toy");
    EXPECT_EQ(with([](WorldRecord& r) { r.task = "hard"; }), "made for task hard of world toy, not for test");
    EXPECT_EQ(with([](WorldRecord& r) { r.channels = test::robots_world().channels; }),
              "made for 12 sensors and 3 effectors, not for 19 and 2");
    EXPECT_EQ(with([](WorldRecord& r) { r.checksum = 255; }),
              "made with another build of toy.so (checksum 00000000000000ff, now 0123456789abcdef)");
    EXPECT_EQ(with([](WorldRecord& r) { r.settings = ""; }), "made with other settings of world toy");
    EXPECT_EQ(with([](WorldRecord& r) { r.reward_unit = "balls"; }), "its rewards are balls, not points");
    EXPECT_EQ(with([](WorldRecord& r) { r.outcome_size = 5; }), "its outcomes have 5 numbers, not 4");
    EXPECT_EQ(with([](WorldRecord& r) { r.height = 7; }), "made in a world of 10 x 7, not 10 x 5");
    EXPECT_EQ(with([](WorldRecord& r) { r.file = "renamed.so"; }), "") << "the checksum tells builds apart";
}

TEST(WhyOther, does_not_compare_what_was_not_recorded) {
    WorldRecord only_channels;
    only_channels.channels = test::toys_world().channels;
    EXPECT_EQ(why_other(only_channels, test::toys_world()), "");
    EXPECT_EQ(why_other({}, test::toys_world()), "");
    EXPECT_NE(why_other(only_channels, test::robots_world()), "");
}
