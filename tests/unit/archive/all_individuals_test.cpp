#include <lore/archive/all_individuals.h>

#include "archive/largest_allocation.h"
#include "archive/random_population.h"
#include "archive/zstd_claim.h"
#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gmock/gmock.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

using namespace lore;

namespace {

struct Remembered {
    IndividualId id;
    std::optional<IndividualId> parent;
    Genome genome;
    double reward;
    friend bool operator==(Remembered const&, Remembered const&) = default;
};

std::vector<Remembered> read(std::string const& path, int through) {
    std::vector<Remembered> all;
    for_each_individual(path, through, [&](ArchivedIndividual const& one) {
        all.push_back({one.id, one.parent, one.genome, one.reward});
    });
    return all;
}

/// A run of `generations` that archives everybody; returns what it saw.
std::vector<Remembered> archived_run(std::string const& path, int generations,
                                     WorldRecord const& world = test::robots_world()) {
    AllIndividualsWriter writer{path, world};
    std::vector<Remembered> seen;
    PretendedEvaluator evaluator;
    evolve(small_evolution(generations, world.interface()), 1, evaluator, {}, [&](GenerationReport const& report) {
        for (Individual const& child : report.born) {
            Birth const& birth = *child.birth;
            seen.push_back(
                {birth.id, birth.parent ? std::optional{birth.parent->id} : std::nullopt, birth.genome, birth.reward});
        }
        writer.add(report);
        return true;
    });
    writer.finish();
    return seen;
}

}   // namespace

TEST(AllIndividuals, are_read_back_in_order_of_birth) {
    Scratch const scratch;
    auto const seen = archived_run(scratch.file("all"), 80);
    EXPECT_EQ(read(scratch.file("all"), 80), seen);
    EXPECT_EQ(seen.size(), 40u + 80u * 20u);
    AllIndividualsSummary const summary = check_all_individuals(scratch.file("all"));
    EXPECT_EQ(summary.generations, 81);
    EXPECT_EQ(summary.individuals, seen.size());
    EXPECT_EQ(summary.bytes, std::filesystem::file_size(scratch.file("all")));
}

TEST(AllIndividuals, of_any_world_keep_fractional_rewards_and_the_world) {
    Scratch const scratch;
    WorldRecord const world = test::toys_world();
    auto const seen = archived_run(scratch.file("all"), 10, world);
    EXPECT_EQ(read(scratch.file("all"), 10), seen);
    EXPECT_LT(seen.front().reward, 1e9);
    EXPECT_EQ(seen.front().genome.interface, world.interface());
    EXPECT_TRUE(std::any_of(seen.begin(), seen.end(), [](Remembered const& one) { return one.reward < 0; }));
    EXPECT_EQ(check_all_individuals(scratch.file("all")).world, world);
}

TEST(AllIndividuals, keep_any_finite_reward_and_refuse_others) {
    Scratch const scratch;
    for (double const reward : {0.0, 3.0, 0x1p30, 0x1p30 + 1, 0.5, -2.0, 1e300, std::nan("")}) {
        class Rewards : public PretendedEvaluator {
        public:
            double reward = 0;
            std::vector<Evaluation> evaluate(std::span<Genome const* const> genomes,
                                             CompletionListener* listener) override {
                auto evaluations = PretendedEvaluator::evaluate(genomes, listener);
                for (Evaluation& evaluation : evaluations) evaluation.reward = reward;
                return evaluations;
            }
        } evaluator;
        evaluator.reward = std::isnan(reward) ? 0.5 : reward;
        std::string const path = scratch.file("all");
        AllIndividualsWriter writer{path, test::robots_world()};
        evolve(small_evolution(0), 1, evaluator, {}, [&](GenerationReport const& report) {
            auto born = std::vector<Individual>(report.born.begin(), report.born.end());
            auto birth = std::make_shared<Birth>(*born[3].birth);
            birth->reward = reward;
            born[3].birth = birth;
            GenerationReport changed = report;
            changed.born = born;
            writer.add(changed);
            return true;
        });
        writer.finish();
        if (std::isnan(reward)) EXPECT_THROW(read(path, 0), Error);
        else EXPECT_EQ(read(path, 0)[3].reward, reward);
    }
}

TEST(AllIndividuals, take_less_than_75_bytes_each) {
    Scratch const scratch;
    auto const seen = archived_run(scratch.file("all"), 400);
    double const each =
        static_cast<double>(std::filesystem::file_size(scratch.file("all"))) / static_cast<double>(seen.size());
    RecordProperty("bytes_an_individual", std::to_string(each));
    EXPECT_LT(each, 75) << "800 000 individuals are to take less than 60 MB";
}

TEST(AllIndividuals, are_the_same_bytes_after_a_run_was_cut_back_to_its_checkpoint) {
    Scratch const scratch;
    constexpr int generations = 700;   // several frames
    archived_run(scratch.file("straight"), generations);
    std::string const path = scratch.file("resumed");
    PretendedEvaluator evaluator;
    EvolutionState state;
    AllIndividualsMark mark;
    {
        AllIndividualsWriter writer{path, test::robots_world()};
        evolve(small_evolution(generations), 1, evaluator, {}, [&](GenerationReport const& report) {
            writer.add(report);
            if (report.generation == 310) {
                state = *report.state;
                mark = writer.mark();
            }
            return report.generation < 650;   // killed after frames that no checkpoint knows
        });
    }
    EXPECT_LT(mark.bytes, std::filesystem::file_size(path));
    EXPECT_FALSE(mark.gathered.empty());
    AllIndividualsWriter writer{path, mark, state.population};
    evolve(small_evolution(generations), 1, evaluator, state, [&](GenerationReport const& report) {
        writer.add(report);
        return true;
    });
    writer.finish();
    EXPECT_EQ(read_file(path), read_file(scratch.file("straight")));
    mark.bytes = 1u << 30;
    EXPECT_THROW(AllIndividualsWriter(path, mark, state.population), Error);
}

TEST(AllIndividuals, that_end_too_early_or_were_cut_or_changed_are_refused) {
    Scratch const scratch;
    archived_run(scratch.file("all"), 6);
    EXPECT_THROW(read(scratch.file("all"), 7), Error);
    EXPECT_EQ(read(scratch.file("all"), 3).size(), 40u + 3u * 20u);
    auto const bytes = read_file(scratch.file("all"));
    auto const refused = [&](std::vector<std::byte> const& content) {
        FILE* const file = std::fopen(scratch.file("bad").c_str(), "wb");   // no need for durable writes here
        if (!content.empty()) std::fwrite(content.data(), 1, content.size(), file);
        std::fclose(file);
        try {
            read(scratch.file("bad"), 6);
        } catch (Error const&) { return true; }
        return false;
    };
    EXPECT_FALSE(refused(bytes));
    for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 30)
        EXPECT_TRUE(refused({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)})) << length;
    for (std::size_t at = 0; at < bytes.size(); at += 1 + at / 30) {
        auto changed = bytes;
        changed[at] ^= std::byte{0x10};
        EXPECT_TRUE(refused(changed)) << at;
    }
}

TEST(AllIndividuals, notice_a_lost_frame) {
    Scratch const scratch;
    archived_run(scratch.file("all"), 700);
    auto const bytes = read_file(scratch.file("all"));
    auto const end_of_frame = [&](std::size_t at) {
        std::uint64_t stored = 0;
        std::memcpy(&stored, bytes.data() + at + 16, sizeof stored);
        return at + 32 + stored;
    };
    std::size_t const second = end_of_frame(container_length(bytes, "all")), third = end_of_frame(second);
    ASSERT_LT(third, bytes.size());
    std::vector<std::byte> lost{bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(second)};
    lost.insert(lost.end(), bytes.begin() + static_cast<std::ptrdiff_t>(third), bytes.end());
    write_file_atomically(scratch.file("lost"), std::span<std::byte const>{lost});
    try {
        read(scratch.file("lost"), 700);
        FAIL();
    } catch (Error const& error) { EXPECT_THAT(error.what(), ::testing::HasSubstr("changed or lost")); }
}

TEST(AllIndividuals, of_a_tiny_frame_that_claims_to_be_huge_take_no_memory) {
    Scratch const scratch;
    std::uint64_t const claimed = std::uint64_t{1} << 28;   // the most that any frame may have
    Bytes const packed = zstd_claiming(claimed);
    struct Frame {
        std::uint32_t mark, generations;
        std::uint64_t raw_length, stored_length;
    } const frame{0x4d415246, 1, claimed, packed.size()};
    std::uint64_t const sum =
        XXH3_64bits_withSeed(packed.data(), packed.size(), XXH3_64bits_withSeed(&frame, sizeof frame, 0));
    { AllIndividualsWriter const only_a_head{scratch.file("head"), test::robots_world()}; }
    Bytes file = read_file(scratch.file("head"));
    auto const append = [&](void const* data, std::size_t size) {
        auto const* const first = static_cast<std::byte const*>(data);
        file.insert(file.end(), first, first + size);
    };
    append(&frame, sizeof frame);
    append(&sum, sizeof sum);
    append(packed.data(), packed.size());
    write_file_atomically(scratch.file("forged"), std::span<std::byte const>{file});
    take_largest_allocation();
    try {
        read(scratch.file("forged"), 0);
        FAIL();
    } catch (Error const& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("a frame does not have the length that its header states"));
    }
    EXPECT_LT(take_largest_allocation(), 10000u);
}
