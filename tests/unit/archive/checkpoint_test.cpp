#include <lore/archive/checkpoint.h>

#include "archive/random_population.h"
#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <functional>
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
    checkpoint.world = test::robots_world();
    checkpoint.seed = 1;
    checkpoint.config_digest = 77;
    checkpoint.progress_bytes = 123;
    checkpoint.seconds = 1.5;
    return checkpoint;
}

Bytes first_of(Bytes const& bytes, std::size_t length) {
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)};
}

}   // namespace

TEST(Checkpoint, continues_to_the_same_bytes_as_a_straight_run_from_any_generation) {
    PretendedEvaluator evaluator;
    auto const go_on = [](GenerationReport const&) { return true; };
    EvolutionState const straight = evolved(30);
    for (int stop : {0, 1, 4, 5, 6, 17, 29, 30}) {
        Checkpoint const read = unpack_checkpoint({pack_checkpoint(checkpoint_at(stop))}, "x");
        EvolutionState const resumed = evolve(small_evolution(30), 1, evaluator, read.state, go_on);
        EXPECT_EQ(resumed.signature.value(), straight.signature.value()) << stop;
        Checkpoint a = checkpoint_at(0), b = a;
        a.state = straight;
        b.state = resumed;
        EXPECT_EQ(pack_checkpoint(a), pack_checkpoint(b)) << stop;
    }
}

TEST(Checkpoint, of_any_world_keeps_the_world_and_fractional_rewards) {
    WorldRecord const world = test::toys_world();
    auto const go_on = [](GenerationReport const&) { return true; };
    PretendedEvaluator evaluator;
    Checkpoint checkpoint;
    checkpoint.state = evolved(12, 1, world.interface());
    checkpoint.world = world;
    Checkpoint const read = unpack_checkpoint({pack_checkpoint(checkpoint)}, "x");
    EXPECT_EQ(read.world, world);
    EXPECT_EQ(best_of_run(read.state.population).birth->reward, best_of_run(checkpoint.state.population).birth->reward);
    EXPECT_NE(best_of_run(read.state.population).birth->reward, 0);
    EXPECT_EQ(*read.state.population.members[5].descriptors, *checkpoint.state.population.members[5].descriptors);
    EvolutionConfig const config = small_evolution(20, world.interface());
    EXPECT_EQ(evolve(config, 1, evaluator, read.state, go_on).signature.value(),
              evolved(20, 1, world.interface()).signature.value());
}

TEST(Checkpoint, is_refused_with_bits_above_the_last_channel_or_in_half_a_step) {
    auto const forged = [](auto const& forge) {
        Checkpoint checkpoint;
        checkpoint.world = test::toys_world();   // 21 channels: two words a step
        checkpoint.state = evolved(1, 1, checkpoint.world.interface());
        Individual& victim = checkpoint.state.population.members[3];
        auto descriptors = std::make_shared<Descriptors>(*victim.descriptors);
        forge(descriptors->channel_bits);
        victim.descriptors = std::move(descriptors);
        return pack_checkpoint(checkpoint);
    };
    using Words = std::vector<std::uint16_t>;
    EXPECT_NO_THROW(unpack_checkpoint({forged([](Words& words) { words[6] = 0xffff, words[7] = 0x1f; })}, "x"));
    EXPECT_THROW(unpack_checkpoint({forged([](Words& words) { words[7] = 0x20; })}, "x"), Error);
    EXPECT_THROW(unpack_checkpoint({forged([](Words& words) { words.pop_back(); })}, "x"), Error);
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
        Checkpoint checkpoint = checkpoint_at(0);
        checkpoint.state = evolve(config, 1, evaluator, {}, {});
        Checkpoint const read = unpack_checkpoint({pack_checkpoint(checkpoint)}, "x");
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
    found = read_checkpoint(path, older);
    EXPECT_EQ(found.checkpoint.state.population.generation, 2);
    EXPECT_THAT(found.warning, ::testing::HasSubstr("checkpoint.lore: the run was killed as it wrote one. Going on"));
    std::filesystem::remove(path);
    EXPECT_THROW(read_checkpoint(path, older), Error);
}

TEST(Checkpoint, of_a_newer_lore_is_left_where_it_is) {
    Scratch const scratch;
    std::string const path = scratch.file("checkpoint.lore"), older = scratch.file("older.lore");
    for (int generation : {1, 2}) write_checkpoint(path, older, checkpoint_at(generation));
    auto bytes = read_file(path);
    bytes[8] = std::byte{container_version + 1};   // its format
    write_file_atomically(path, std::span<std::byte const>{bytes});
    auto const older_bytes = read_file(older);
    EXPECT_THROW(read_checkpoint(path, older), NewerFormat);
    EXPECT_EQ(read_file(path), bytes);
    EXPECT_EQ(read_file(older), older_bytes);
}

TEST(Checkpoint, that_cannot_be_read_for_now_is_left_where_it_is) {
    Scratch const scratch;
    std::string const path = scratch.file("checkpoint.lore"), older = scratch.file("older.lore");
    for (int generation : {1, 2}) write_checkpoint(path, older, checkpoint_at(generation));
    auto const older_bytes = read_file(older);
    std::filesystem::rename(path, scratch.file("kept"));
    std::filesystem::create_directory(path);   // opens, and cannot be read
    EXPECT_THROW(read_checkpoint(path, older), Error);
    EXPECT_TRUE(std::filesystem::is_directory(path));
    EXPECT_EQ(read_file(older), older_bytes);
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
        EXPECT_THROW(unpack_checkpoint({first_of(payload, length)}, "x"), Error) << length;
}

TEST(Checkpoint, survives_a_changed_byte_anywhere) {
    Bytes payload = pack_checkpoint(checkpoint_at(1));
    for (std::size_t at = 0; at < payload.size(); at += at < 1000 ? 1 : 53) {
        payload[at] ^= std::byte{0xff};
        try {
            unpack_checkpoint({payload}, "x");
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
    EXPECT_NO_THROW(unpack_checkpoint({forged([](Descriptors&) {})}, "x"));
    float const not_a_number = std::numeric_limits<float>::quiet_NaN();
    for (auto const& forge : std::initializer_list<std::function<void(Descriptors&)>>{
             [](Descriptors& d) { d.outcome.pop_back(); }, [=](Descriptors& d) { d.outcome[0] = not_a_number; },
             [](Descriptors& d) {
                 d.path[0] = {200, 3};
             },
             [](Descriptors& d) { d.entropies[2] = std::numeric_limits<double>::infinity(); },
             [](Descriptors& d) { d.entropies.pop_back(); }, [](Descriptors& d) { d.channel_bits[7] = 1u << 15; }})
        EXPECT_THROW(unpack_checkpoint({forged(forge)}, "x"), Error);
    Checkpoint nobody = checkpoint_at(1);
    nobody.state.population.members.clear();
    EXPECT_THROW(unpack_checkpoint({pack_checkpoint(nobody)}, "x"), Error);
}
