#include <lore/cluster/farm.h>

#include "archive/random_population.h"
#include "share.h"
#include "support/pointers.h"

#include <lore/behavior/mean_distances.h>

#include <gtest/gtest.h>

#include <cstdlib>

using namespace lore;
using lore::test::pointers_to;

namespace {

Session* session = nullptr;

/// Of evaluations long enough for messages of the usual size, and for robots that touch things.
EvaluationContext const& context() {
    static EvaluationContext const source{
        std::make_shared<CollectballWorld>(load_arena("collectball", "source")), {1000}, {}};
    return source;
}

/// Rank 0 says what comes next; see main.
void call_workers(char word) { session->world().broadcast({static_cast<std::byte>(word)}); }

/// A Farm whose workers have been called to serve.
struct Served {
    Served() { call_workers('s'); }
    Farm farm{session->world(), context()};
};

std::vector<Genome> founders(int count, std::uint32_t generation) {
    std::vector<Genome> genomes;
    for (int slot = 0; slot < count; ++slot)
        genomes.push_back(
            founder(test::robot, Stream{5, Purpose::founder, generation, static_cast<std::uint32_t>(slot)}));
    return genomes;
}

}   // namespace

TEST(Farm, gives_evaluations_in_the_order_of_the_request) {
    Served served;
    for (int count : {0, 1, 2, 3, 7, 16, 17, 64, 200, 403}) {
        auto const genomes = founders(count, static_cast<std::uint32_t>(count));
        auto const pointers = pointers_to(genomes);
        EXPECT_EQ(served.farm.evaluator().evaluate(pointers), evaluate_batch(context(), pointers)) << count;
    }
}

TEST(ShareOfAWorker, is_even_in_half_sets_and_leaves_the_rest_to_rank_0) {
    EXPECT_EQ(share_of_a_worker(200, 2, 32), 112) << "3 1/2 sets, and 2 3/4 for rank 0";
    EXPECT_EQ(share_of_a_worker(200, 2, 16), 104);
    EXPECT_EQ(share_of_a_worker(200, 4, 32), 64);
    EXPECT_EQ(share_of_a_worker(3, 8, 32), 16);
    EXPECT_EQ(share_of_a_worker(0, 2, 32), 0);
    EXPECT_EQ(share_of_a_worker(5, 2, 1), 3) << "without lanes";
}

TEST(Farm, notifies_of_each_evaluation_once_where_others_are_at_work) {
    Served served;
    auto const genomes = founders(200, 0);
    auto const pointers = pointers_to(genomes);
    struct : CompletionListener {
        std::vector<Evaluation> expected;
        std::vector<int> notified;
        void completed(int index, Evaluation const& evaluation) override {
            ++notified[static_cast<std::size_t>(index)];
            EXPECT_EQ(evaluation, expected[static_cast<std::size_t>(index)]) << index;
        }
    } listener;
    listener.expected = evaluate_batch(context(), pointers);
    listener.notified.assign(genomes.size(), 0);
    served.farm.evaluator().evaluate(pointers, &listener);
    EXPECT_EQ(listener.notified, std::vector<int>(genomes.size(), session->size() > 1 ? 1 : 0));
}

TEST(Farm, measures_every_distance_as_one_rank_does) {
    Served served;
    int const size = 300;   // so many that Hamming distances are shared
    auto const genomes = founders(size, 0);
    auto const pointers = pointers_to(genomes);
    auto const evaluations = evaluate_batch(context(), pointers);
    std::vector<Descriptors const*> pool;
    for (Evaluation const& evaluation : evaluations) pool.push_back(&evaluation.descriptors);
    for (DistanceKind kind :
         {DistanceKind::adhoc, DistanceKind::hamming, DistanceKind::trajectory, DistanceKind::entropy})
        for (int known : {0, 1, 40, 270, size - 1, size}) {
            DistanceMatrix expected{size}, matrix{size};
            measure_rows(kind, pool, known, size, expected);
            served.farm.distances().measure(kind, pool, known, matrix);
            EXPECT_EQ(matrix, expected) << name(kind) << " " << known;
        }
    for (RankTimes const& rank : served.farm.stop()) EXPECT_GT(rank.distances, 0);
}

TEST(Farm, finds_every_mean_distance_as_one_rank_does) {
    Served served;
    auto const genomes = founders(30, 0);
    auto const evaluations = evaluate_batch(context(), pointers_to(genomes));
    for (int const size : {1, 30, 1000, 1201}) {   // from 1000 on they are shared
        std::vector<Descriptors const*> pool;
        while (static_cast<int>(pool.size()) < size)
            pool.push_back(&evaluations[pool.size() * 7 % evaluations.size()].descriptors);
        for (DistanceKind const kind : {DistanceKind::adhoc, DistanceKind::entropy})
            EXPECT_EQ(served.farm.distances().means(kind, pool), mean_distances(kind, pool))
                << name(kind) << " " << size;
    }
    for (RankTimes const& rank : served.farm.stop()) EXPECT_GT(rank.distances, 0);
}

TEST(Farm, evolves_to_the_signature_of_a_single_process_whatever_the_delays) {
    EvolutionConfig config = small_evolution(6);
    config.population = 150;   // so many that some distances are measured while others are under way
    config.founders = 200;
    auto const go_on = [](GenerationReport const&) { return true; };
    SerialEvaluator alone{context()};
    auto const expected = evolve(config, 3, alone, {}, go_on).signature.value();
    for (char const* delay : {"0", "3"}) {
        ::setenv("LORE_TEST_DELAY", delay, 1);
        call_workers(*delay);
        Served served;
        EXPECT_EQ(evolve(config, 3, served.farm.evaluator(), served.farm.distances(), {}, go_on).signature.value(),
                  expected)
            << delay;
    }
    ::unsetenv("LORE_TEST_DELAY");
    call_workers('0');
}

TEST(Farm, evolves_a_large_population_to_the_signature_of_a_single_process) {
    EvolutionConfig config = small_evolution(2);
    config.population = config.founders = 520;   // so many that no distance is measured while others are under way
    auto const go_on = [](GenerationReport const&) { return true; };
    SerialEvaluator alone{context()};
    config.distance_schedule.distances = {DistanceKind::hamming, DistanceKind::trajectory};
    for (int const period : {1, 9}) {   // with a change of distance, and without
        config.distance_schedule.period = period;
        auto const expected = evolve(config, 3, alone, {}, go_on).signature.value();
        Served served;
        EXPECT_EQ(evolve(config, 3, served.farm.evaluator(), served.farm.distances(), {}, go_on).signature.value(),
                  expected)
            << period;
        for (RankTimes const& rank : served.farm.stop()) EXPECT_GT(rank.distances, 0);
    }
}

TEST(Farm, accounts_for_the_time_of_every_rank) {
    Served served;
    auto const genomes = founders(64, 0);
    auto const pointers = pointers_to(genomes);
    served.farm.evaluator().evaluate(pointers);
    auto const times = served.farm.stop();
    ASSERT_EQ(times.size(), static_cast<std::size_t>(session->size()));
    for (RankTimes const& rank : times) {
        EXPECT_GT(rank.evaluation, 0);
        EXPECT_GT(rank.processor, 0);
    }
}

TEST(Communicator, gathers_texts_in_order_of_rank) {
    call_workers('g');
    auto const texts = session->world().gather("rank 0");
    ASSERT_EQ(texts.size(), static_cast<std::size_t>(session->size()));
    for (std::size_t rank = 0; rank < texts.size(); ++rank) EXPECT_EQ(texts[rank], "rank " + std::to_string(rank));
}

/// Rank 0 runs the tests; the others do what it calls.
int main(int argc, char** argv) {
    Session this_session{argc, argv};
    session = &this_session;
    if (session->rank() == 0) {
        ::testing::InitGoogleTest(&argc, argv);
        int const failed = RUN_ALL_TESTS();
        call_workers('e');
        return failed;
    }
    while (true) {
        switch (std::to_integer<char>(session->world().broadcast({}).at(0))) {
        case 's': serve(session->world(), context()); break;
        case 'g': session->world().gather("rank " + std::to_string(session->rank())); break;
        case '0': ::unsetenv("LORE_TEST_DELAY"); break;
        case '3': ::setenv("LORE_TEST_DELAY", "3", 1); break;
        default: return 0;
        }
    }
}
