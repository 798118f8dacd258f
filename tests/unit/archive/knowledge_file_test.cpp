#include <lore/archive/knowledge_file.h>

#include "archive/random_population.h"
#include "support/complaint.h"
#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/archive/container.h>
#include <lore/archive/knowledge_export.h>
#include <lore/core/error.h>
#include <lore/core/random.h>

#include <gmock/gmock.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <limits>

using namespace lore;
using ::testing::HasSubstr;

namespace {

/// Which parts of the evidence a base has.
struct Parts {
    int gammas = 0;
    bool credit = false, contrast = false;
};

EvidenceArrays some_evidence(Stream& rng, int features, Parts const& parts) {
    EvidenceArrays evidence;
    for (int i = 0; i < parts.gammas; ++i) evidence.gammas.push_back(0.5 + 0.01 * i);
    evidence.has_credit = parts.credit;
    if (parts.contrast) evidence.success_reward = 1.5, evidence.successes = 20, evidence.failures = 30;
    for (int i = 0; i < features; ++i) {
        if (parts.gammas > 0) evidence.showings.push_back(1 + rng.below(9));
        for (int gamma = 0; gamma < parts.gammas; ++gamma) evidence.return_sums.push_back(rng.uniform());
        if (parts.credit) {
            evidence.news.push_back(rng.below(9));
            evidence.gain_sums.push_back(rng.uniform(-3, 3));
        }
        if (parts.contrast) {
            evidence.successes_that_showed.push_back(rng.below(21));
            evidence.failures_that_showed.push_back(rng.below(31));
        }
    }
    return evidence;
}

KnowledgeBase some_base(int features, int window_length, Parts const& parts = {},
                        Channels const& channels = collectball_channels()) {
    Stream rng{1, Purpose::test, 0, static_cast<std::uint32_t>(features)};
    KnowledgeArrays arrays;
    for (int i = 0; i < features; ++i) {
        for (int step = 0; step < window_length; ++step) {
            for (int word = 0; word < channels.words(); ++word)
                arrays.bits.push_back(static_cast<std::uint16_t>(rng.below(1u << 16) & binary_mask(channels, word)));
            for (int channel = 0; channel < channels.continuous_count(); ++channel)
                arrays.windows.push_back(static_cast<float>(rng.uniform()));
        }
        arrays.counts.push_back(1 + rng.below(9));
        arrays.reward_sums.push_back(rng.below(30) - 7.25);
        arrays.values.push_back(arrays.reward_sums.back() / arrays.counts.back());
    }
    arrays.evidence = some_evidence(rng, features, parts);
    Provenance provenance;
    if (parts.gammas > 0) provenance.value = "return 0.5";
    provenance.made_by = "lore-kb build runs/s1 \"quoted\" \xC3\xA9";
    provenance.kind = "lineage";
    provenance.index = "exact";
    provenance.sources = {"runs/s1"};
    provenance.derivation = {"top 3", "random"};
    provenance.task = "collectball source";
    provenance.individuals = 12;
    provenance.windows = 1u << 30;
    provenance.best_reward = 7;
    return KnowledgeBase{{window_length, 1.83f, channels}, provenance, std::move(arrays)};
}

template <class T>
std::vector<T> copy_of(std::span<T const> items) {
    return {items.begin(), items.end()};
}

void expect_equal(KnowledgeBase const& a, KnowledgeBase const& b) {
    EXPECT_EQ(a.config(), b.config());
    EXPECT_EQ(a.provenance(), b.provenance());
    EXPECT_EQ(copy_of(a.parts().bits), copy_of(b.parts().bits));
    EXPECT_EQ(copy_of(a.parts().windows), copy_of(b.parts().windows));
    EXPECT_EQ(copy_of(a.values()), copy_of(b.values()));
    EXPECT_EQ(copy_of(a.parts().reward_sums), copy_of(b.parts().reward_sums));
    EXPECT_EQ(copy_of(a.parts().counts), copy_of(b.parts().counts));
    Evidence const &left = a.evidence(), &right = b.evidence();
    EXPECT_EQ(left.gammas, right.gammas);
    EXPECT_EQ(copy_of(left.showings), copy_of(right.showings));
    EXPECT_EQ(copy_of(left.return_sums), copy_of(right.return_sums));
    EXPECT_EQ(left.has_credit, right.has_credit);
    EXPECT_EQ(copy_of(left.news), copy_of(right.news));
    EXPECT_EQ(copy_of(left.gain_sums), copy_of(right.gain_sums));
    EXPECT_EQ(left.success_reward, right.success_reward);
    EXPECT_EQ(left.successes, right.successes);
    EXPECT_EQ(left.failures, right.failures);
    EXPECT_EQ(copy_of(left.successes_that_showed), copy_of(right.successes_that_showed));
    EXPECT_EQ(copy_of(left.failures_that_showed), copy_of(right.failures_that_showed));
}

/// The error of reading a file with this content, or "" if it is read.
std::string refusal(Scratch const& scratch, Bytes const& file) {
    std::string const path = scratch.file("some.lorekb");
    std::ofstream{path, std::ios::binary}.write(reinterpret_cast<char const*>(file.data()),
                                                static_cast<std::streamsize>(file.size()));
    return test::complaint_of([&] { read_knowledge_base(path); });
}

Bytes payload_of(Scratch const& scratch, KnowledgeBase const& base) {
    std::string const path = scratch.file("good.lorekb");
    write_knowledge_base(path, base);
    return read_container(path, FileKind::knowledge_base).bytes;
}

/// The error of a file that is whole but whose payload was forged.
std::string refusal_of_payload(Scratch const& scratch, Bytes const& payload) {
    return refusal(scratch, seal(FileKind::knowledge_base, payload, Packing::plain));
}

}   // namespace

TEST(KnowledgeFile, gives_back_what_was_written) {
    Scratch const scratch;
    std::string const path = scratch.file("kb.lorekb");
    for (int window_length : {1, 7, 20})
        for (int features : {0, 1, 5, 100}) {
            KnowledgeBase const base = some_base(features, window_length);
            write_knowledge_base(path, base);
            expect_equal(read_knowledge_base(path), base);
        }
}

TEST(KnowledgeFiles, that_are_used_together_have_windows_of_one_length) {
    Scratch const scratch;
    std::string const a = scratch.file("a.lorekb"), b = scratch.file("b.lorekb"), longer = scratch.file("c.lorekb");
    write_knowledge_base(a, some_base(3, 7));
    write_knowledge_base(b, some_base(5, 7));
    write_knowledge_base(longer, some_base(5, 20));
    std::vector<KnowledgeBase> const both = read_knowledge_bases({a, b});
    ASSERT_EQ(both.size(), 2u);
    expect_equal(both[0], some_base(3, 7));
    expect_equal(both[1], some_base(5, 7));
    EXPECT_TRUE(read_knowledge_bases({}).empty());
    EXPECT_EQ(test::complaint_of<UsageError>([&] {
                  read_knowledge_bases({a, b, longer});
              }),
              "cannot combine " + longer + " with " + a +
                  " (windows of 20 and of 7 steps). Give knowledge bases of one window length.");
}

TEST(KnowledgeFile, gives_back_windows_of_any_channels) {
    Scratch const scratch;
    std::string const path = scratch.file("kb.lorekb");
    std::vector<ChannelInfo> many;
    for (int i = 0; i < 64; ++i) many.push_back({"channel_" + std::to_string(i), i % 3 == 0});
    Channels const binary{{{"a", true}}, {{"b", true}}}, continuous{{{"a", false}}, {{"b", false}}},
        wide{many, {{"left", false}, {"right", true}}};
    for (Channels const& channels : {binary, continuous, test::toys_world().channels, wide}) {
        KnowledgeBase const base = some_base(9, 4, {2, true, true}, channels);
        write_knowledge_base(path, base);
        KnowledgeBase const read = read_knowledge_base(path);
        expect_equal(read, base);
        EXPECT_EQ(world_record(read).channels, channels);
    }
}

TEST(KnowledgeFile, names_the_best_reward_by_the_world_s_unit) {
    Scratch const scratch;
    std::string const path = scratch.file("kb.lorekb");
    KnowledgeBase::Parts parts = some_base(1, 1).parts();
    EXPECT_THAT(provenance_json(KnowledgeBase{parts}), HasSubstr("\"best_balls\": 7,"));
    parts.provenance.reward_unit = "points";
    parts.provenance.best_reward = -1.5;
    KnowledgeBase const base{parts};
    EXPECT_THAT(provenance_json(base), HasSubstr("\"best_points\": -1.5,"));
    write_knowledge_base(path, base);
    expect_equal(read_knowledge_base(path), base);
}

TEST(KnowledgeFile, refuses_bits_of_continuous_channels_and_beyond_the_last) {
    Scratch const scratch;
    Channels const channels = test::toys_world().channels;   // 11 binary channels, 10 continuous; two words a step
    Bytes const good = payload_of(scratch, some_base(1, 2, {}, channels));
    // Values at 64, sums at 128, counts at 192, windows of 80 bytes at 256, bits at 384.
    for (std::size_t const at : {384u, 386u, 388u, 390u}) {
        Bytes payload = good;
        std::uint16_t const all = 0xffff;
        std::memcpy(payload.data() + at, &all, sizeof all);
        EXPECT_THAT(refusal_of_payload(scratch, payload), HasSubstr("unknown channels")) << at;
    }
    EXPECT_EQ(refusal_of_payload(scratch, good), "");
}

TEST(KnowledgeFile, gives_back_every_part_of_the_evidence) {
    Scratch const scratch;
    std::string const path = scratch.file("kb.lorekb");
    for (Parts const parts :
         {Parts{}, {3, false, false}, {0, true, false}, {0, false, true}, {1, true, false}, {16, true, true}})
        for (int features : {0, 1, 5}) {
            KnowledgeBase const base = some_base(features, 3, parts);
            write_knowledge_base(path, base);
            expect_equal(read_knowledge_base(path), base);
        }
}

TEST(KnowledgeFile, refuses_evidence_outside_its_range) {
    Scratch const scratch;
    Bytes const good = payload_of(scratch, some_base(3, 2, {2, true, true}));
    auto const with = [&](std::size_t at, auto number) {
        Bytes payload = good;
        std::memcpy(payload.data() + at, &number, sizeof number);
        return refusal_of_payload(scratch, payload);
    };
    // Three features of two steps: bits at 448, gammas at 512, showings at 576, returns at 640, news at 704, gains at
    // 768, what contrast compares at 832, successes at 896, failures at 960.
    double const not_a_number = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(with(512, 1.0), HasSubstr("gammas"));
    EXPECT_THAT(with(512, 0.9), HasSubstr("gammas"));
    EXPECT_THAT(with(512, not_a_number), HasSubstr("gammas"));
    EXPECT_THAT(with(576, std::uint64_t{0}), HasSubstr("nobody showed"));
    EXPECT_THAT(with(640, not_a_number), HasSubstr("evidence is not finite"));
    EXPECT_THAT(with(768, not_a_number), HasSubstr("evidence is not finite"));
    EXPECT_THAT(with(832 + 16, not_a_number), HasSubstr("successes is not finite"));
    EXPECT_THAT(with(896, std::uint32_t{21}), HasSubstr("more have shown"));
    EXPECT_THAT(with(960, std::uint32_t{31}), HasSubstr("more have shown"));
    EXPECT_THAT(with(20, std::uint32_t{0}), HasSubstr("no known kind"));
    EXPECT_THAT(with(20, std::uint32_t{17}), HasSubstr("no known kind"));
    EXPECT_THAT(with(20, std::uint32_t{16}), HasSubstr("do not fit"));
    EXPECT_THAT(with(40, std::uint64_t{8 + 7}), HasSubstr("no known kind"));
    EXPECT_EQ(with(768, -2.5), "");
}

TEST(KnowledgeFile, aligns_its_arrays_to_cache_lines) {
    Scratch const scratch;
    std::string const path = scratch.file("kb.lorekb");
    write_knowledge_base(path, some_base(5, 7));
    KnowledgeBase const base = read_knowledge_base(path);
    for (void const* start :
         {static_cast<void const*>(base.parts().windows.data()), static_cast<void const*>(base.parts().bits.data()),
          static_cast<void const*>(base.values().data())})
        EXPECT_EQ(std::bit_cast<std::uintptr_t>(start) % 64, 0u);
}

TEST(KnowledgeFile, outlives_the_file_it_was_mapped_from) {
    Scratch const scratch;
    std::string const path = scratch.file("kb.lorekb");
    KnowledgeBase const written = some_base(50, 20);
    write_knowledge_base(path, written);
    KnowledgeBase const base = read_knowledge_base(path);
    write_knowledge_base(path, some_base(3, 20));   // replaced by renaming: the mapping still shows the former file
    expect_equal(base, written);
}

TEST(KnowledgeFile, detects_truncation_at_every_length) {
    Scratch const scratch;
    write_knowledge_base(scratch.file("kb.lorekb"), some_base(2, 2));
    Bytes const whole = read_file(scratch.file("kb.lorekb"));
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(refusal(scratch, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))), "")
            << length;
}

TEST(KnowledgeFile, detects_every_changed_byte) {
    Scratch const scratch;
    write_knowledge_base(scratch.file("kb.lorekb"), some_base(2, 2));
    Bytes whole = read_file(scratch.file("kb.lorekb"));
    for (std::size_t at = 0; at < whole.size(); ++at) {
        whole[at] ^= std::byte{0x10};
        EXPECT_NE(refusal(scratch, whole), "") << at;
        whole[at] ^= std::byte{0x10};
    }
    EXPECT_EQ(refusal(scratch, whole), "");
}

TEST(KnowledgeFile, refuses_numbers_outside_their_range_in_a_file_that_is_whole) {
    Scratch const scratch;
    Bytes const good = payload_of(scratch, some_base(3, 2));
    auto const with = [&](std::size_t at, auto number) {
        Bytes payload = good;
        std::memcpy(payload.data() + at, &number, sizeof number);
        return refusal_of_payload(scratch, payload);
    };
    // Three features of two steps: values at 64, sums at 128, counts at 192, windows at 256 (144 bytes), bits at 448.
    EXPECT_THAT(with(64, std::numeric_limits<double>::quiet_NaN()), HasSubstr("not finite"));
    EXPECT_THAT(with(128, std::numeric_limits<double>::infinity()), HasSubstr("not finite"));
    EXPECT_THAT(with(192, std::uint32_t{0}), HasSubstr("nobody"));
    EXPECT_THAT(with(256, std::numeric_limits<float>::quiet_NaN()), HasSubstr("0 .. 1"));
    EXPECT_THAT(with(256 + 140, 1.5f), HasSubstr("0 .. 1"));
    EXPECT_THAT(with(448, std::uint16_t{0x200}), HasSubstr("unknown channels"));
    EXPECT_THAT(with(0, std::uint32_t{4}), HasSubstr("newer Lore"));
    EXPECT_THAT(with(4, std::uint32_t{0}), HasSubstr("window length"));
    EXPECT_THAT(with(4, std::uint32_t{3}), HasSubstr("do not fit"));
    EXPECT_THAT(with(8, std::numeric_limits<float>::quiet_NaN()), HasSubstr("threshold"));
    EXPECT_THAT(with(12, std::uint32_t{8}), HasSubstr("it has 8 binary and 6 continuous channels, its world 9 and 6"));
    EXPECT_THAT(with(12, std::uint32_t{75}), HasSubstr("it has 75 binary and 6 continuous channels"));
    EXPECT_THAT(with(16, ~std::uint32_t{0}), HasSubstr("channels"));
    EXPECT_THAT(with(24, std::uint64_t{40}), HasSubstr("do not fit"));
    EXPECT_THAT(with(24, ~std::uint64_t{0}), HasSubstr("do not fit"));
    EXPECT_THAT(with(32, ~std::uint64_t{0}), HasSubstr("do not fit"));
    EXPECT_THAT(with(good.size() - 1, '['), HasSubstr("provenance"));
    EXPECT_EQ(with(64, 3.5), "");
}

TEST(KnowledgeFile, refuses_a_container_of_another_kind_and_a_missing_file) {
    Scratch const scratch;
    EXPECT_THAT(refusal(scratch, seal(FileKind::lineage, payload_of(scratch, some_base(1, 1)))),
                HasSubstr("not a knowledge base"));
    EXPECT_THROW(read_knowledge_base(scratch.file("none.lorekb")), Error);
}
