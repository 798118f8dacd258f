#include <lore/archive/messages.h>

#include "archive/random_population.h"
#include "support/pointers.h"

#include <lore/core/error.h>
#include <lore/network/mutation.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace lore;
using lore::test::pointers_to;

namespace {

std::vector<Genome> mutated_genomes(int count, Interface interface = test::robot) {
    std::vector<Genome> genomes;
    for (int i = 0; i < count; ++i) {
        Stream rng{3, Purpose::test, 0, static_cast<std::uint32_t>(i)};
        Genome genome = founder(interface, rng);
        for (int k = 0; k < i; ++k) mutate(genome, {}, {}, rng);
        genomes.push_back(std::move(genome));
    }
    return genomes;
}

std::vector<Delivery> deliveries_of(std::vector<Genome> const& genomes, int steps) {
    std::vector<Delivery> deliveries;
    for (Evaluation& evaluation : PretendedEvaluator{steps}.evaluate(pointers_to(genomes)))
        deliveries.push_back({1000 - static_cast<int>(deliveries.size()), std::move(evaluation)});
    return deliveries;
}

}   // namespace

TEST(Messages, carry_genomes_and_evaluations_unchanged) {
    for (int count : {0, 1, 2, 40}) {
        auto const genomes = mutated_genomes(count);
        EXPECT_EQ(unpack_genomes(pack_genomes(pointers_to(genomes))), genomes);
        auto const deliveries = deliveries_of(genomes, 4000);
        Bytes const bytes = pack_deliveries(deliveries);
        EXPECT_EQ(unpack_deliveries(bytes), deliveries);
        // The pretended bits change at every step: they take hardly more than in memory.
        if (count > 0) { EXPECT_LT(bytes.size() / static_cast<std::size_t>(count), 9000u); }
    }
}

TEST(Messages, hold_as_many_evaluations_as_their_bytes_allow_and_one_at_least) {
    auto const genomes = mutated_genomes(40);
    auto const deliveries = deliveries_of(genomes, 400);
    std::size_t const together = pack_deliveries(deliveries).size();
    for (std::size_t const longest : {std::size_t{1}, together / 40, together / 7, together - 1, together}) {
        std::vector<Delivery> carried;
        auto const messages = pack_deliveries(deliveries, longest);
        for (std::size_t i = 0; i < messages.size(); ++i) {
            auto const some = unpack_deliveries(messages[i]);
            EXPECT_TRUE(messages[i].size() <= longest || some.size() == 1) << messages[i].size() << " " << longest;
            carried.insert(carried.end(), some.begin(), some.end());
            if (i + 1 == messages.size()) continue;
            // The next evaluation would not have fitted.
            EXPECT_GT(
                pack_deliveries(std::span{deliveries}.subspan(carried.size() - some.size(), some.size() + 1)).size() +
                    2,
                longest);
        }
        EXPECT_EQ(carried, deliveries);
    }
    EXPECT_EQ(pack_deliveries(deliveries, 1).size(), 40u);
    EXPECT_EQ(pack_deliveries(deliveries, together + 2).size(), 1u);
    EXPECT_TRUE(pack_deliveries({}, 100).empty());
}

TEST(Messages, carry_genomes_and_evaluations_of_any_interface) {
    for (Interface const interface : {Interface{1, 1}, {19, 2}, {64, 16}}) {
        auto const genomes = mutated_genomes(12, interface);
        EXPECT_EQ(unpack_genomes(pack_genomes(pointers_to(genomes))), genomes);
        auto const deliveries = deliveries_of(genomes, 400);
        EXPECT_EQ(unpack_deliveries(pack_deliveries(deliveries)), deliveries);
    }
}

TEST(Messages, carry_bits_that_repeat_in_little_space) {
    Stream rng{1, Purpose::test};
    for (int length : {0, 1, 2, 127, 128, 129, 4000}) {
        Delivery delivery;
        std::vector<std::uint16_t>& bits = delivery.evaluation.descriptors.channel_bits;
        while (static_cast<int>(bits.size()) < length)
            bits.insert(bits.end(),
                        std::min<std::size_t>(1 + rng.below(300), static_cast<std::size_t>(length) - bits.size()),
                        static_cast<std::uint16_t>(rng.below(1u << 15)));
        Bytes const bytes = pack_deliveries({&delivery, 1});
        EXPECT_EQ(unpack_deliveries(bytes).at(0), delivery);
        EXPECT_LT(bytes.size(), 400u);
    }
}

TEST(Messages, carry_bits_of_many_channels_that_repeat_in_little_space) {
    Stream rng{2, Purpose::test};
    for (int const channels : {16, 17, 48, 80})
        for (int const steps : {0, 1, 2, 17, 4000}) {
            Delivery delivery;
            Descriptors& descriptors = delivery.evaluation.descriptors;
            descriptors.entropies.resize(static_cast<std::size_t>(channels));
            int const words = descriptors.words();
            std::vector<std::uint16_t> step(static_cast<std::size_t>(words));
            for (int s = 0; s < steps; ++s) {
                if (s % 300 == 0)   // one word alone changes
                    step[rng.below(static_cast<std::uint32_t>(words))] = static_cast<std::uint16_t>(rng.below(1u << 8));
                descriptors.channel_bits.insert(descriptors.channel_bits.end(), step.begin(), step.end());
            }
            Bytes const bytes = pack_deliveries({&delivery, 1});
            EXPECT_EQ(unpack_deliveries(bytes).at(0), delivery) << channels << " " << steps;
            // An entropy a channel, a byte for 64 words, and at most 12 bytes for a change.
            EXPECT_LT(bytes.size(), 100u + 8 * channels + descriptors.channel_bits.size() / 64 + 14 * 12);
        }
}

TEST(Messages, carry_what_a_distance_compares_and_the_rows_of_its_matrix) {
    auto const genomes = mutated_genomes(12);
    auto const evaluations = PretendedEvaluator{4000}.evaluate(pointers_to(genomes));
    std::vector<Descriptors const*> pool;
    for (Evaluation const& evaluation : evaluations) pool.push_back(&evaluation.descriptors);
    ComparedPool carried;
    for (int kind = 0; kind < distance_kinds; ++kind) {
        DistanceMatrix expected{12}, here{12}, there{12};
        measure_rows(static_cast<DistanceKind>(kind), pool, 3, 9, expected);
        unpack_pool(pack_pool(static_cast<DistanceKind>(kind), 5, pool), carried);   // where another pool was
        EXPECT_EQ(carried.known, 5);
        measure_rows(carried.kind, pointers_to(carried.members), 3, 9, there);
        unpack_distances(pack_distances(there.rows(3, 9)), here.rows(3, 9));
        EXPECT_EQ(here, expected) << kind;
    }
}

TEST(Messages, carry_one_pool_after_another) {
    ComparedPool carried;
    for (int const steps : {4000, 70, 1000})
        for (Interface const interface : {Interface{12, 3}, {19, 2}, {1, 1}}) {
            auto const genomes = mutated_genomes(7, interface);
            auto const evaluations = PretendedEvaluator{steps}.evaluate(pointers_to(genomes));
            std::vector<Descriptors const*> pool;
            for (Evaluation const& evaluation : evaluations) pool.push_back(&evaluation.descriptors);
            unpack_pool(pack_pool(DistanceKind::hamming, 2, pool), carried);
            ASSERT_EQ(carried.members.size(), pool.size());
            for (std::size_t k = 0; k < pool.size(); ++k) {
                EXPECT_EQ(carried.members[k].channel_bits, pool[k]->channel_bits) << steps;
                EXPECT_EQ(carried.members[k].channels(), pool[k]->channels());
            }
        }
}

TEST(Messages, carry_nothing_that_a_distance_does_not_compare) {
    Descriptors member;
    member.outcome = {1, 2};
    member.path = {Tile{3, 4}};
    Descriptors const* const pool[]{&member};
    ComparedPool carried;
    unpack_pool(pack_pool(DistanceKind::trajectory, 1, pool), carried);
    EXPECT_EQ(carried.members.at(0).path, member.path);
    EXPECT_TRUE(carried.members.at(0).outcome.empty());
}

TEST(Messages, answer_bytes_that_nobody_wrote_with_an_error) {
    auto const genomes = mutated_genomes(3);
    Bytes const request = pack_genomes(pointers_to(genomes));
    Bytes const result = pack_deliveries(deliveries_of(genomes, 100));
    for (std::size_t length = 0; length < request.size(); ++length)
        EXPECT_THROW(unpack_genomes(std::span{request}.first(length)), Error);
    for (std::size_t length = 0; length < result.size(); ++length)
        EXPECT_THROW(unpack_deliveries(std::span{result}.first(length)), Error);

    Genome lost = genomes[0];
    lost.edges[0].target = 255;   // no such neuron
    Genome const* const sent[]{&lost};
    EXPECT_THROW(unpack_genomes(pack_genomes(sent)), Error);

    auto const evaluations = PretendedEvaluator{100}.evaluate(pointers_to(genomes));
    Descriptors const* const members[]{&evaluations[0].descriptors, &evaluations[1].descriptors};
    std::vector<double> numbers(9);
    Bytes const distances = pack_distances(numbers);
    for (std::size_t length = 0; length < distances.size(); ++length)
        EXPECT_THROW(unpack_distances(std::span{distances}.first(length), numbers), Error);
    ComparedPool carried;
    for (int kind = 0; kind < distance_kinds; ++kind) {
        Bytes const pool = pack_pool(static_cast<DistanceKind>(kind), 2, members);
        for (std::size_t length = 0; length < pool.size(); ++length)
            EXPECT_THROW(unpack_pool(std::span{pool}.first(length), carried), Error) << kind;
    }
    EXPECT_THROW(unpack_pool(pack_pool(DistanceKind::adhoc, 3, members), carried), Error)
        << "more known than there are";
    EXPECT_THROW(unpack_pool(Bytes{std::byte{distance_kinds}, std::byte{2}, std::byte{0}}, carried), Error);
}

TEST(Messages, answer_robots_that_cannot_be_compared_with_an_error) {
    Descriptors robot, other;
    robot.entropies = {0.5, 0.5};
    robot.channel_bits = {1, 2};
    robot.outcome = {1};
    robot.path = {Tile{0, 11}};
    ComparedPool carried;
    auto const unpacks = [&](DistanceKind kind) {
        Descriptors const* const members[]{&robot, &other};
        unpack_pool(pack_pool(kind, 2, members), carried);
    };
    other = robot;
    for (int kind = 0; kind < distance_kinds; ++kind) unpacks(static_cast<DistanceKind>(kind));
    other.entropies = {0.5};
    EXPECT_THROW(unpacks(DistanceKind::entropy), Error);
    EXPECT_THROW(unpacks(DistanceKind::hamming), Error);
    other.outcome = {};
    EXPECT_THROW(unpacks(DistanceKind::adhoc), Error);
    other.path = {Tile{12, 0}};
    EXPECT_THROW(unpacks(DistanceKind::trajectory), Error);
}
