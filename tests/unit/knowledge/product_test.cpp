#include "knowledge/traces.h"

#include <lore/knowledge/product.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace lore;
using lore::test::base_of;
using lore::test::trace_of;

TEST(ValuesOf, are_those_of_the_matched_features_and_absent_where_none_matches) {
    Shaper const shaper{base_of({{0x000, 0.5f}, {0x01F, 0.5f}}, {-1.0, 5.0})};
    Trace const trace = trace_of({{0x01F, 0.5f}, {0x1FF, 0.5f}, {0x000, 0.5f}});
    EXPECT_EQ(values_of(shaper, windows_of(trace, 1)), (FoundValues{5, std::nullopt, -1}));
}

TEST(ProductOf, multiplies_by_window_and_is_0_where_some_base_does_not_find_it) {
    std::vector<FoundValues> const values{{2, 3, std::nullopt, std::nullopt, -1},
                                          {4, std::nullopt, 5, std::nullopt, 2}};
    EXPECT_EQ(product_of(values), (std::vector<double>{8, 0, 0, 0, -2}));
}

TEST(ProductOf, is_0_where_some_base_does_not_find_it_whatever_the_others_values_are) {
    double const infinity = std::numeric_limits<double>::infinity();
    std::vector<FoundValues> const values{{-1, infinity, std::nullopt}, {std::nullopt, std::nullopt, -2}, {-3, 1, -3}};
    for (double const product : product_of(values)) {
        EXPECT_EQ(product, 0);
        EXPECT_FALSE(std::signbit(product));
    }
}

TEST(ProductOf, a_single_base_is_its_values_with_0_for_not_found) {
    std::vector<FoundValues> const values{{2, 0, std::nullopt}};
    EXPECT_EQ(product_of(values), (std::vector<double>{2, 0, 0}));
}
