#include <lore/archive/lineage_file.h>

#include "archive/random_population.h"
#include "support/scratch.h"

#include <lore/archive/container.h>
#include <lore/archive/genome_file.h>
#include <lore/core/error.h>
#include <lore/evolution/lineage.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace lore;

namespace {

void expect_equal(Birth const& a, Birth const& b) {
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.genome, b.genome);
    EXPECT_EQ(a.reward, b.reward);
    EXPECT_EQ(a.shaping, b.shaping);
    EXPECT_EQ(a.diversity, b.diversity);
    ASSERT_EQ(a.parent == nullptr, b.parent == nullptr);
    if (a.parent) { EXPECT_EQ(a.parent->id, b.parent->id); }
}

Bytes first_of(Bytes const& bytes, std::size_t length) {
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)};
}

}   // namespace

TEST(LineageFile, gives_back_every_ancestor_of_the_last_population_linked_and_in_order_of_birth) {
    Scratch const scratch;
    Population const population = evolved(60).population;
    write_lineage(scratch.file("lineage.lore"), population, test::robots_world());
    LineageArchive const lineage = read_lineage(scratch.file("lineage.lore"));
    auto const expected = ancestors_of(population.members);
    ASSERT_EQ(lineage.births.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) expect_equal(*lineage.births[i], *expected[i]);
    EXPECT_EQ(lineage.generation, 60);
    EXPECT_EQ(lineage.best, best_of_run(population).id());
    ASSERT_EQ(lineage.last_population.size(), population.members.size());
    for (std::size_t i = 0; i < population.members.size(); ++i)
        EXPECT_EQ(lineage.last_population[i], population.members[i].id());
    EXPECT_EQ(lineage_of(*lineage.find(lineage.best)).size(), lineage_of(*best_of_run(population).birth).size());
    EXPECT_THROW(lineage.find({1, 999}), Error);
}

TEST(LineageFile, says_where_founders_came_from_and_without_that_has_the_bytes_it_always_had) {
    Scratch const scratch;
    Population const population = evolved(3).population;
    FoundersOrigin const origin{"clones of a knowledge base", "elsewhere/founders.lore", "0123456789abcdef"};
    write_lineage(scratch.file("random"), population, test::robots_world());
    write_lineage(scratch.file("cloned"), population, test::robots_world(), origin);
    EXPECT_EQ(read_lineage(scratch.file("random")).founders, std::nullopt);
    EXPECT_EQ(read_lineage(scratch.file("cloned")).founders, origin);
    Bytes const random = read_container(scratch.file("random"), FileKind::lineage).bytes;
    Bytes const cloned = read_container(scratch.file("cloned"), FileKind::lineage).bytes;
    ASSERT_GT(cloned.size(), random.size());
    EXPECT_TRUE(std::equal(random.begin(), random.end(), cloned.begin()));
    for (std::size_t length = random.size() + 1; length < cloned.size(); ++length)
        EXPECT_THROW(unpack_lineage({first_of(cloned, length)}, "x"), Error) << length;
}

TEST(LineageFile, refuses_a_payload_cut_at_any_length_behind_a_right_checksum) {
    Scratch const scratch;
    write_lineage(scratch.file("a"), evolved(3).population, test::robots_world());
    Bytes const payload = read_container(scratch.file("a"), FileKind::lineage).bytes;
    for (std::size_t length = 0; length < payload.size(); length += length < 300 ? 1 : 97)
        EXPECT_THROW(unpack_lineage({first_of(payload, length)}, "x"), Error) << length;
}

TEST(LineageFile, answers_a_changed_byte_behind_a_right_checksum_with_an_error_or_a_valid_archive) {
    Scratch const scratch;
    write_lineage(scratch.file("a"), evolved(1).population, test::robots_world());
    Bytes payload = read_container(scratch.file("a"), FileKind::lineage).bytes;
    int refused = 0;
    for (std::size_t at = 0; at < payload.size(); at += at < 600 ? 1 : 31) {
        for (auto const flip : {std::byte{0xff}, std::byte{0x80}}) {
            payload[at] ^= flip;
            try {
                LineageArchive const lineage = unpack_lineage({payload}, "x");
                for (auto const& birth : lineage.births) ASSERT_EQ(why_invalid(birth->genome), "");
            } catch (Error const&) { ++refused; }
            payload[at] ^= flip;
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(LineageFile, of_any_world_says_which_and_keeps_fractional_rewards) {
    Scratch const scratch;
    WorldRecord const world = test::toys_world();
    Population const population = evolved(20, 1, world.interface()).population;
    write_lineage(scratch.file("a"), population, world);
    LineageArchive const lineage = read_lineage(scratch.file("a"));
    EXPECT_EQ(lineage.world, world);
    auto const expected = ancestors_of(population.members);
    ASSERT_EQ(lineage.births.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) expect_equal(*lineage.births[i], *expected[i]);
    EXPECT_NE(expected[0]->reward, std::floor(expected[0]->reward));
}

TEST(LineageFile, with_genomes_of_another_interface_than_its_world_s_is_refused) {
    Scratch const scratch;
    write_lineage(scratch.file("a"), evolved(3).population, test::toys_world());
    EXPECT_THROW(read_lineage(scratch.file("a")), Error);
}

TEST(GenomeFile, gives_back_a_failed_individual) {
    Scratch const scratch;
    WorldRecord const world = test::toys_world();
    FailedIndividual const failed{
        {17, 3}, founder(world.interface(), Stream{1, Purpose::founder}), 2, "out of memory", world};
    write_genome(scratch.file("g"), failed);
    FailedIndividual const read = read_genome(scratch.file("g"));
    EXPECT_EQ(read.id, failed.id);
    EXPECT_EQ(read.genome, failed.genome);
    EXPECT_EQ(read.world, world);
    EXPECT_EQ(read.rank, 2);
    EXPECT_EQ(read.reason, failed.reason);
}
