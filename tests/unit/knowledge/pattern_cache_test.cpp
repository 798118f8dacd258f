#include "pattern_cache.h"

#include <lore/core/random.h>

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <vector>

using namespace lore;
using exact::Candidate;
using exact::PatternCache;

namespace {

/// What would be remembered of a pattern: a list that follows from it.
std::vector<Candidate> list_of(std::uint64_t pattern) {
    std::vector<Candidate> list;
    for (std::uint64_t i = 0; i < pattern % 7; ++i)
        list.push_back({{{}, static_cast<std::int32_t>(pattern % 1000 + i)}, static_cast<std::int32_t>(i)});
    return list;
}

void expect_kept(PatternCache const& cache, std::array<std::uint64_t, 3> const& words) {
    auto const* const known = cache.find(words.data());
    ASSERT_NE(known, nullptr);
    auto const kept = cache.candidates(*known);
    std::vector<Candidate> const expected = list_of(words[0]);
    ASSERT_EQ(kept.size(), expected.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
        EXPECT_EQ(kept[i].digest.feature, expected[i].digest.feature);
        EXPECT_EQ(kept[i].differing, expected[i].differing);
    }
}

}   // namespace

TEST(PatternCache, holds_fewer_patterns_the_longer_they_are) {
    constexpr int words = 1 << 14;   // 128 kB a slot, two slots a pattern
    PatternCache cache{words};
    std::vector<std::uint64_t> pattern(words);
    for (std::uint64_t i = 0; i < 200; ++i) {
        pattern[0] = i;
        cache.add(pattern.data(), {});
        EXPECT_LE(cache.size(), 64u);
        EXPECT_NE(cache.find(pattern.data()), nullptr);
    }
}

TEST(PatternCache, knows_what_was_added_and_nothing_else_while_it_grows) {
    PatternCache cache{3};
    Stream rng{31, Purpose::test};
    std::map<std::array<std::uint64_t, 3>, bool> added;
    for (int i = 0; i < 5000; ++i) {
        std::array<std::uint64_t, 3> const words{rng.below(300), rng.below(3), rng.below(9)};   // many meet again
        EXPECT_EQ(cache.find(words.data()) != nullptr, added.contains(words));
        if (!added.contains(words)) cache.add(words.data(), list_of(words[0]));
        added[words] = true;
        expect_kept(cache, words);
    }
    EXPECT_EQ(cache.size(), added.size());
    for (auto const& [words, unused] : added) expect_kept(cache, words);
}

TEST(PatternCache, forgets_rather_than_growing_beyond_its_limits) {
    PatternCache few_patterns{3, 10, 1000}, few_candidates{3, 1000, 12};
    for (std::uint64_t pattern = 0; pattern < 200; ++pattern) {
        std::array<std::uint64_t, 3> const words{pattern, 0, 0};
        for (PatternCache* cache : {&few_patterns, &few_candidates}) {
            auto const kept = cache->add(words.data(), list_of(pattern));
            EXPECT_EQ(kept.size(), list_of(pattern).size());
            expect_kept(*cache, words);
            EXPECT_LE(cache->size(), 10u);
        }
    }
}
