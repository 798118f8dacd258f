#include <lore/core/names.h>

#include <cstdint>

#include <gtest/gtest.h>

using namespace lore;

namespace {

enum class Season : std::uint8_t { spring, summer, autumn };
constexpr auto seasons = names_for<Season>("spring", "summer", "fall");

}   // namespace

TEST(Names, are_found_by_value_and_values_by_name) {
    EXPECT_EQ(seasons[Season::autumn], "fall");
    EXPECT_EQ(seasons.find("summer"), Season::summer);
    EXPECT_EQ(seasons.choice("spring", "a season"), Season::spring);
    EXPECT_FALSE(seasons.find("autumn"));
    EXPECT_FALSE(seasons.find(""));
}

TEST(Names, that_are_unknown_are_refused_with_all_that_are_known) {
    try {
        seasons.choice("winter", "a season");
        FAIL();
    } catch (UsageError const& error) {
        EXPECT_STREQ(error.what(), "'winter' is not a season (known are spring, summer, fall). Correct the name.");
    }
}
