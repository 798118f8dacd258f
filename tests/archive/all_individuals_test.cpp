#include <lore/archive/all_individuals.h>

#include "archive/random_population.h"
#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>

#include <gmock/gmock.h>

#include <cstdio>
#include <cstring>
#include <filesystem>

using namespace lore;

namespace {

struct Remembered {
    IndividualId id;
    std::optional<IndividualId> parent;
    Genome genome;
    int balls;
    friend bool operator==(Remembered const&, Remembered const&) = default;
};

std::vector<Remembered> read(std::string const& path, int through) {
    std::vector<Remembered> all;
    for_each_individual(path, through, [&](ArchivedIndividual const& one) { all.push_back({one.id, one.parent, one.genome, one.balls}); });
    return all;
}

/// A run of `generations` that archives everybody, as `flush_every` has it; returns what it saw.
std::vector<Remembered> archived_run(std::string const& path, int generations, int flush_every) {
    AllIndividualsWriter writer{path};
    std::vector<Remembered> seen;
    PretendedEvaluator evaluator;
    evolve(small_evolution(generations), 1, evaluator, {}, [&](GenerationReport const& report) {
        for (Individual const& child : report.born) {
            Birth const& birth = *child.birth;
            seen.push_back({birth.id, birth.parent ? std::optional{birth.parent->id} : std::nullopt, birth.genome, birth.balls});
        }
        writer.add(report);
        if (report.generation % flush_every == 0) writer.flush();
        return true;
    });
    writer.flush();
    return seen;
}

} // namespace

TEST(AllIndividuals, are_read_back_in_order_of_birth) {
    Scratch const scratch;
    auto const seen = archived_run(scratch.file("all"), 80, 7);
    EXPECT_EQ(read(scratch.file("all"), 80), seen);
    EXPECT_EQ(seen.size(), 40u + 80u * 20u);
    AllIndividualsSummary const summary = check_all_individuals(scratch.file("all"));
    EXPECT_EQ(summary.generations, 81);
    EXPECT_EQ(summary.individuals, seen.size());
    EXPECT_EQ(summary.bytes, std::filesystem::file_size(scratch.file("all")));
}

TEST(AllIndividuals, take_less_than_75_bytes_each) {
    Scratch const scratch;
    auto const seen = archived_run(scratch.file("all"), 400, 100);
    double const each = static_cast<double>(std::filesystem::file_size(scratch.file("all"))) / static_cast<double>(seen.size());
    RecordProperty("bytes_an_individual", std::to_string(each));
    EXPECT_LT(each, 75) << "800 000 individuals are to take less than 60 MB";
}

TEST(AllIndividuals, are_the_same_bytes_after_a_run_was_cut_back_to_its_checkpoint) {
    Scratch const scratch;
    auto const seen = archived_run(scratch.file("straight"), 30, 10);
    std::string const path = scratch.file("resumed");
    PretendedEvaluator evaluator;
    EvolutionState state;
    std::uint64_t bytes = 0, chain = 0;
    {
        AllIndividualsWriter writer{path};
        evolve(small_evolution(30), 1, evaluator, {}, [&](GenerationReport const& report) {
            writer.add(report);
            if (report.generation % 10 == 0) writer.flush();
            if (report.generation == 10) { state = *report.state; bytes = writer.bytes(); chain = writer.chain(); }
            return report.generation < 23;   // killed after frames that no checkpoint knows
        });
    }
    AllIndividualsWriter writer{path, bytes, chain, state.population};
    evolve(small_evolution(30), 1, evaluator, state, [&](GenerationReport const& report) {
        writer.add(report);
        if (report.generation % 10 == 0) writer.flush();
        return true;
    });
    writer.flush();
    EXPECT_EQ(read(path, 30), seen);
    EXPECT_EQ(read_file(path), read_file(scratch.file("straight")));
    EXPECT_THROW(AllIndividualsWriter(path, 1u << 30, chain, state.population), Error);
}

TEST(AllIndividuals, that_end_too_early_or_were_cut_or_changed_are_refused) {
    Scratch const scratch;
    archived_run(scratch.file("all"), 6, 2);
    EXPECT_THROW(read(scratch.file("all"), 7), Error);
    EXPECT_EQ(read(scratch.file("all"), 3).size(), 40u + 3u * 20u);
    auto const bytes = read_file(scratch.file("all"));
    auto const refused = [&](std::vector<std::byte> const& content) {
        FILE* const file = std::fopen(scratch.file("bad").c_str(), "wb");   // no need for durable writes here
        std::fwrite(content.data(), 1, content.size(), file);
        std::fclose(file);
        try { read(scratch.file("bad"), 6); } catch (Error const&) { return true; }
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

TEST(AllIndividuals, notice_frames_that_were_swapped) {
    Scratch const scratch;
    archived_run(scratch.file("all"), 2, 1);
    auto const bytes = read_file(scratch.file("all"));
    auto const length_at = [&](std::size_t at) { std::uint64_t length; std::memcpy(&length, bytes.data() + at + 16, 8); return 32 + length; };
    std::size_t const first = 64, second = first + length_at(first), third = second + length_at(second);
    std::vector<std::byte> lost{bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(second)};
    lost.insert(lost.end(), bytes.begin() + static_cast<std::ptrdiff_t>(third), bytes.end());
    write_file_atomically(scratch.file("lost"), std::span<std::byte const>{lost});
    try {
        read(scratch.file("lost"), 2);
        FAIL();
    } catch (Error const& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("changed or lost"));
    }
}
