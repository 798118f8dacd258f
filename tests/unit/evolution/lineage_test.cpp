#include <lore/core/random.h>
#include <lore/evolution/lineage.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace lore;

namespace {

std::shared_ptr<Birth const> child_of(std::shared_ptr<Birth const> parent, IndividualId id) {
    auto birth = std::make_shared<Birth>();
    birth->id = id;
    birth->parent = std::move(parent);
    return birth;
}

Individual individual(std::shared_ptr<Birth const> birth) {
    Individual individual;
    individual.birth = std::move(birth);
    return individual;
}

}   // namespace

TEST(LineageOf, runs_from_the_individual_to_its_founder) {
    auto const founder = child_of(nullptr, {0, 7});
    auto const parent = child_of(founder, {2, 1});
    auto const child = child_of(parent, {5, 0});
    EXPECT_EQ(lineage_of(*child), (std::vector<Birth const*>{child.get(), parent.get(), founder.get()}));
    EXPECT_EQ(lineage_of(*founder), std::vector<Birth const*>{founder.get()});
}

TEST(AncestorsOf, names_each_once_in_order_of_birth) {
    auto const founder = child_of(nullptr, {0, 7});
    auto const other_founder = child_of(nullptr, {0, 2});
    auto const parent = child_of(founder, {2, 1});
    auto const left = child_of(parent, {5, 9});
    auto const right = child_of(parent, {5, 0});
    std::vector<Individual> const members{individual(left), individual(other_founder), individual(right),
                                          individual(parent)};
    EXPECT_EQ(ancestors_of(members),
              (std::vector<Birth const*>{other_founder.get(), founder.get(), parent.get(), right.get(), left.get()}));
    EXPECT_TRUE(ancestors_of({}).empty());
}

TEST(Birth, of_a_very_long_lineage_is_released_without_recursion) {
    std::shared_ptr<Birth const> last = child_of(nullptr, {});
    for (std::uint32_t g = 1; g < 2'000'000; ++g) last = child_of(std::move(last), {g, 0});
    last.reset();   // a recursive release would overflow the stack
    SUCCEED();
}

TEST(Birth, releases_only_the_part_of_a_lineage_that_nobody_else_remembers) {
    auto founder = child_of(nullptr, {0, 0});
    auto shared = child_of(founder, {1, 0});
    auto doomed = child_of(shared, {2, 0});
    auto kept = child_of(shared, {2, 1});
    std::weak_ptr<Birth const> const doomed_seen = doomed, shared_seen = shared;
    auto last = child_of(std::move(doomed), {3, 0});
    doomed.reset();
    shared.reset();
    last.reset();
    EXPECT_TRUE(doomed_seen.expired());
    ASSERT_FALSE(shared_seen.expired());
    EXPECT_EQ(kept->parent->parent, founder);
}

TEST(Birth, of_extinct_branches_takes_no_memory_however_long_the_run) {
    // Neutral evolution: the survivors' tree coalesces in about as many generations as there are individuals, so living
    // ancestors stay near constant while births pile up.
    Stream rng{41, Purpose::test};
    constexpr std::uint32_t size = 20;
    std::vector<std::weak_ptr<Birth const>> everybody;
    std::vector<std::shared_ptr<Birth const>> living(size);
    for (std::uint32_t g = 0; g <= 3000; ++g) {
        std::vector<std::shared_ptr<Birth const>> next;
        for (std::uint32_t slot = 0; slot < size; ++slot) {
            next.push_back(child_of(living[rng.below(size)], {g, slot}));
            everybody.push_back(next.back());
        }
        living = std::move(next);
        if (g % 500 != 499) continue;
        std::vector<Individual> members;
        for (auto const& birth : living) members.push_back(individual(birth));
        auto const alive =
            std::count_if(everybody.begin(), everybody.end(), [](auto const& birth) { return !birth.expired(); });
        EXPECT_EQ(static_cast<std::size_t>(alive), ancestors_of(members).size());
        EXPECT_LT(alive,
                  static_cast<std::ptrdiff_t>(g + 1) + 400);   // one common chain, and the young branches at its end
    }
}
