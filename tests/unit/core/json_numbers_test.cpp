#include <lore/core/shortest_digits.h>
#include <lore/core/whole_number.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace lore;
using nlohmann::json;

TEST(WholeNumber, is_one_of_the_range_expected_and_nothing_else) {
    EXPECT_EQ(whole_number<int>(json(-7)), -7);
    EXPECT_EQ(whole_number<std::uint64_t>(json(std::numeric_limits<std::uint64_t>::max())),
              std::numeric_limits<std::uint64_t>::max());
    for (json const& other : {json(1.0), json(1e300), json(std::int64_t{1} << 40), json("7"), json::array(), json()})
        EXPECT_THROW(whole_number<int>(other), std::out_of_range) << other;
    EXPECT_THROW(whole_number<std::uint64_t>(json(-1)), std::out_of_range);
}

TEST(WholeNumber, is_refused_without_writing_what_is_nested_deeper_than_the_stack) {
    std::string const deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
    try {
        whole_number<int>(json::parse(deep));
        FAIL() << "an array is no number";
    } catch (std::out_of_range const& error) {
        EXPECT_STREQ(error.what(), "a value of type array is not a whole number of the range expected");
    }
    EXPECT_THROW(json::parse(deep, refuse_deep_nesting<json>), std::out_of_range);
    EXPECT_EQ(json::parse("[[7]]", refuse_deep_nesting<json>)[0][0], 7);
}

TEST(ShortestDigits, of_a_float_read_back_to_it_and_are_no_more_than_it_has) {
    EXPECT_EQ(json(shortest_digits(3.3f)).dump(), "3.3");
    for (float const value : {0.0f, -0.0f, 0.1f, 1e-45f, 3.4e38f, -16777216.0f, 1.0f / 3.0f}) {
        EXPECT_EQ(static_cast<float>(shortest_digits(value)), value);
        EXPECT_EQ(std::signbit(shortest_digits(value)), std::signbit(value));
    }
}
