#include <lore/archive/checkpoint.h>

#include "archive/random_population.h"
#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <limits>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace lore;

namespace {

Checkpoint checkpoint_at(int generation) {
    Checkpoint checkpoint;
    checkpoint.state = evolved(generation);
    checkpoint.seed = 1;
    checkpoint.config_digest = 77;
    checkpoint.progress_bytes = 123;
    checkpoint.seconds = 1.5;
    return checkpoint;
}

}   // namespace

TEST(Checkpoint, continues_to_the_same_bytes_as_a_straight_run_from_any_generation) {
    PretendedEvaluator evaluator;
    auto const go_on = [](GenerationReport const&) { return true; };
    EvolutionState const straight = evolved(30);
    for (int stop : {0, 1, 4, 5, 6, 17, 29, 30}) {
        Checkpoint const read = unpack_checkpoint(pack_checkpoint(checkpoint_at(stop)), "x");
        EvolutionState const resumed = evolve(small_evolution(30), 1, evaluator, read.state, go_on);
        EXPECT_EQ(resumed.signature.value(), straight.signature.value()) << stop;
        Checkpoint a, b;
        a.state = straight;
        b.state = resumed;
        EXPECT_EQ(pack_checkpoint(a), pack_checkpoint(b)) << stop;
    }
}

TEST(Checkpoint, keeps_the_features_shown_of_a_run_shaped_by_share) {
    class Shows : public PretendedEvaluator {
    public:
        std::vector<Evaluation> evaluate(std::span<Genome const* const> genomes,
                                         CompletionListener* listener) override {
            auto evaluations = PretendedEvaluator::evaluate(genomes, listener);
            for (std::size_t i = 0; i < genomes.size(); ++i)
                for (std::uint32_t feature = 0; feature < 3; ++feature)
                    if (genomes[i]->biases[feature] > 0.5f) evaluations[i].shown.push_back(feature);
            return evaluations;
        }
    };
    Shows evaluator;
    EvolutionConfig config = small_evolution(12);
    config.use_shaping = true;
    config.shaping.rule = ShapingRule::share;
    config.feature_values = {1, 2, 4};
    std::uint64_t const straight = evolve(config, 1, evaluator, {}, {}).signature.value();
    for (int stop : {0, 5, 11}) {
        config.generations = stop;
        Checkpoint checkpoint;
        checkpoint.state = evolve(config, 1, evaluator, {}, {});
        Checkpoint const read = unpack_checkpoint(pack_checkpoint(checkpoint), "x");
        config.generations = 12;
        EXPECT_EQ(evolve(config, 1, evaluator, read.state, {}).signature.value(), straight) << stop;
    }
}

TEST(Checkpoint, keeps_the_last_two_and_falls_back_to_the_older_with_a_warning) {
    Scratch const scratch;
    std::string const path = scratch.file("checkpoint.lore"), older = scratch.file("older.lore");
    for (int generation : {1, 2, 3}) write_checkpoint(path, older, checkpoint_at(generation));
    FoundCheckpoint found = read_checkpoint(path, older);
    EXPECT_EQ(found.checkpoint.state.population.generation, 3);
    EXPECT_EQ(found.checkpoint.progress_bytes, 123u);
    EXPECT_EQ(found.warning, "");

    auto bytes = read_file(path);
    bytes[bytes.size() / 2] ^= std::byte{1};
    write_file_atomically(path, std::span<std::byte const>{bytes});
    found = read_checkpoint(path, older);
    EXPECT_EQ(found.checkpoint.state.population.generation, 2);
    EXPECT_THAT(found.warning, ::testing::HasSubstr("checksum mismatch"));

    EXPECT_EQ(read_checkpoint(path, older).warning, "") << "the damaged one is gone";

    write_checkpoint(path, older, checkpoint_at(3));
    std::filesystem::remove(path);
    EXPECT_EQ(read_checkpoint(path, older).checkpoint.state.population.generation, 2);
    std::filesystem::remove(path);
    EXPECT_THROW(read_checkpoint(path, older), Error);
}

TEST(Checkpoint, never_keeps_a_damaged_one_in_place_of_the_whole_one) {
    Scratch const scratch;
    std::string const path = scratch.file("checkpoint.lore"), older = scratch.file("older.lore");
    for (int generation : {1, 2}) write_checkpoint(path, older, checkpoint_at(generation));
    auto bytes = read_file(path);
    bytes.pop_back();
    write_file_atomically(path, std::span<std::byte const>{bytes});
    write_checkpoint(path, older, read_checkpoint(path, older).checkpoint);
    for (std::string const& one : {path, older})
        EXPECT_EQ(unpack_checkpoint(read_container(one, FileKind::checkpoint), one).state.population.generation, 1);
}

TEST(Checkpoint, that_cannot_be_written_leaves_both_former_ones) {
    Scratch const scratch;
    std::string const path = scratch.file("checkpoint.lore"), older = scratch.file("older.lore");
    for (int generation : {1, 2}) write_checkpoint(path, older, checkpoint_at(generation));
    auto const newer_bytes = read_file(path), older_bytes = read_file(older);
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
    rlimit const small{1000, limit.rlim_max};
    std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(write_checkpoint(path, older, checkpoint_at(3)), Error);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_EQ(read_file(path), newer_bytes);
    EXPECT_EQ(read_file(older), older_bytes);
}

TEST(Checkpoint, whose_writing_is_killed_anywhere_leaves_one_whole_and_never_two_names_of_one_file) {
    Scratch const scratch;
    std::string const path = scratch.file("checkpoint.lore"), older = scratch.file("older.lore");
    Checkpoint const first = checkpoint_at(1), second = checkpoint_at(2);
    for (int attempt = 0; attempt < 60; ++attempt) {
        write_checkpoint(path, older, first);
        pid_t const writer = ::fork();
        if (writer == 0)
            while (true) write_checkpoint(path, older, second);
        ::usleep(static_cast<useconds_t>(attempt * 57));
        ::kill(writer, SIGKILL);
        ::waitpid(writer, nullptr, 0);
        struct stat a {
        }, b{};
        bool const both = ::stat(path.c_str(), &a) == 0 && ::stat(older.c_str(), &b) == 0;
        EXPECT_TRUE(!both || a.st_ino != b.st_ino) << attempt;
        EXPECT_GE(read_checkpoint(path, older).checkpoint.state.population.generation, 1) << attempt;
    }
}

TEST(Checkpoint, refuses_a_payload_cut_at_any_length) {
    Bytes const payload = pack_checkpoint(checkpoint_at(2));
    for (std::size_t length = 0; length < payload.size(); length += length < 400 ? 1 : 131)
        EXPECT_THROW(unpack_checkpoint(std::span{payload}.first(length), "x"), Error) << length;
}

TEST(Checkpoint, survives_a_changed_byte_anywhere) {
    Bytes payload = pack_checkpoint(checkpoint_at(1));
    for (std::size_t at = 0; at < payload.size(); at += at < 1000 ? 1 : 53) {
        payload[at] ^= std::byte{0xff};
        try {
            unpack_checkpoint(payload, "x");
        } catch (Error const&) {}
        payload[at] ^= std::byte{0xff};
    }
}

TEST(Checkpoint, is_refused_with_descriptors_that_no_evaluation_gives) {
    auto const forged = [](auto const& forge) {
        Checkpoint checkpoint = checkpoint_at(1);
        Individual& victim = checkpoint.state.population.members[3];
        auto descriptors = std::make_shared<Descriptors>(*victim.descriptors);
        forge(*descriptors);
        victim.descriptors = std::move(descriptors);
        return pack_checkpoint(checkpoint);
    };
    EXPECT_NO_THROW(unpack_checkpoint(forged([](Descriptors&) {}), "x"));
    EXPECT_THROW(unpack_checkpoint(forged([](Descriptors& d) { d.ball_positions.pop_back(); }), "x"), Error);
    EXPECT_THROW(
        unpack_checkpoint(
            forged([](Descriptors& d) { d.ball_positions[0].x = std::numeric_limits<float>::quiet_NaN(); }), "x"),
        Error);
    EXPECT_THROW(unpack_checkpoint(forged([](Descriptors& d) { d.path[0] = {200, 3}; }), "x"), Error);
    EXPECT_THROW(unpack_checkpoint(
                     forged([](Descriptors& d) { d.entropies[2] = std::numeric_limits<double>::infinity(); }), "x"),
                 Error);
    Checkpoint nobody = checkpoint_at(1);
    nobody.state.population.members.clear();
    EXPECT_THROW(unpack_checkpoint(pack_checkpoint(nobody), "x"), Error);
}
