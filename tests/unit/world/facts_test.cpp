#include <lore/world/facts.h>

#include <gmock/gmock.h>

#include <limits>

namespace lore {
namespace {

using ::testing::HasSubstr;

WorldFacts small_facts() {
    WorldFacts facts;
    facts.name = "pendulum";
    facts.task = "short_pole";
    facts.reward_unit = "rad";
    facts.sensors = {{"angle", false}, {"up2", true}};
    facts.effectors = {{"torque", false}};
    return facts;
}

/// What is wrong after one change.
template <class Change>
std::string why_after(Change const& change) {
    WorldFacts facts = small_facts();
    change(facts);
    return why_invalid(facts);
}

std::vector<ChannelInfo> channels(int count, std::string const& stem) {
    std::vector<ChannelInfo> all;
    for (int c = 0; c < count; ++c) all.push_back({stem + std::to_string(c), c % 2 == 0});
    return all;
}

TEST(WorldFacts, may_be_as_large_as_the_bounds) {
    EXPECT_EQ(why_invalid(small_facts()), "");
    EXPECT_EQ(why_after([](WorldFacts& facts) {
                  facts.sensors = channels(most_sensors, "s");
                  facts.effectors = channels(most_effectors, "e");
                  facts.outcome_size = most_outcomes;
                  facts.max_batch = 1;
                  facts.width = largest_world;
                  facts.name = std::string(longest_name, 'a');
              }),
              "");
}

TEST(WorldFacts, have_identifiers_for_names) {
    for (std::string const& bad :
         std::vector<std::string>{"", "Upper", "1st", "with space", "hyphen-ated", "_", "a\n", "\xc3\xa4"})
        for (auto const set : {+[](WorldFacts&f, std::string const&n) { f.name = n; },
                               +[](WorldFacts&f, std::string const&n) { f.task = n; },
                               +[](WorldFacts&f, std::string const&n) { f.sensors[1].name = n; },
                               +[](WorldFacts&f, std::string const&n) { f.effectors[0].name = n; }}) {
            std::string const why = why_after([&](WorldFacts& facts) { set(facts, bad); });
            EXPECT_NE(why, "") << bad;
            EXPECT_EQ(why.find('\n'), std::string::npos);
        }
    EXPECT_THAT(why_after([](WorldFacts& facts) { facts.task = std::string(longest_name + 1, 'b'); }),
                HasSubstr("41 bytes, and 40 at most"));
}

TEST(WorldFacts, name_each_channel_once) {
    EXPECT_THAT(why_after([](WorldFacts& facts) { facts.effectors[0].name = "angle"; }),
                HasSubstr("two channels are called 'angle'"));
}

TEST(WorldFacts, have_counts_and_sizes_within_bounds) {
    EXPECT_THAT(why_after([](WorldFacts& facts) { facts.sensors = channels(65, "s"); }), HasSubstr("sensors is 65"));
    EXPECT_THAT(why_after([](WorldFacts& facts) { facts.effectors.clear(); }), HasSubstr("effectors is 0"));
    EXPECT_THAT(why_after([](WorldFacts& facts) { facts.outcome_size = -1; }), HasSubstr("outcome_size is -1"));
    EXPECT_THAT(why_after([](WorldFacts& facts) { facts.max_batch = 0; }), HasSubstr("max_batch is 0"));
    for (float const size : {0.0f, -1.0f, 2e6f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_THAT(why_after([&](WorldFacts& facts) { facts.height = size; }), HasSubstr("its height is"));
    for (std::string const& unit : {std::string{}, std::string{"a\tb"}, std::string(41, 'u'), std::string{"m\xb2"}})
        EXPECT_THAT(why_after([&](WorldFacts& facts) { facts.reward_unit = unit; }), HasSubstr("reward unit"));
    EXPECT_EQ(why_after([](WorldFacts& facts) { facts.reward_unit = "m\xc2\xb2 gained"; }), "") << "UTF-8 is printable";
}

}   // namespace
}   // namespace lore
