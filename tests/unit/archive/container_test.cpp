#include <lore/archive/container.h>

#include "archive/largest_allocation.h"
#include "archive/zstd_claim.h"
#include "support/complaint.h"
#include "support/scratch.h"

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>
#include <lore/core/random.h>

#include <gmock/gmock.h>
#include <xxhash.h>

#include <array>
#include <cstring>

#include <sys/mman.h>

using namespace lore;
using ::testing::HasSubstr;

namespace {

Bytes random_bytes(std::size_t count, std::uint32_t slot) {
    Stream rng{1, Purpose::test, 0, slot};
    Bytes bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(rng.below(slot % 2 == 0 ? 256 : 3));
    return bytes;
}

std::string refusal(Bytes const& file, FileKind kind = FileKind::lineage) {
    return test::complaint_of([&] { unseal(file, kind, "some.lore"); });
}

/// Makes the checksum right again after a change to the header, as a deliberate forger would.
void reseal(Bytes& file) {
    XXH3_state_t* const state = XXH3_createState();
    XXH3_64bits_reset(state);
    XXH3_64bits_update(state, file.data(), 56);
    XXH3_64bits_update(state, file.data() + 64, file.size() - 64);
    std::uint64_t const sum = XXH3_64bits_digest(state);
    XXH3_freeState(state);
    std::memcpy(file.data() + 56, &sum, sizeof sum);
}

}   // namespace

TEST(Container, gives_back_any_payload) {
    for (std::uint32_t slot = 0; slot < 40; ++slot)
        for (Packing packing : {Packing::compressed, Packing::plain}) {
            Bytes const payload = random_bytes(slot * slot * 7, slot);
            EXPECT_EQ(unseal(seal(FileKind::genome, payload, packing), FileKind::genome, "x").bytes, payload);
        }
}

TEST(Container, is_smaller_than_a_payload_of_few_symbols) {
    EXPECT_LT(seal(FileKind::lineage, random_bytes(100000, 1)).size(), 30000u);
}

TEST(Container, detects_truncation_at_every_length_and_a_byte_too_many) {
    for (Packing packing : {Packing::compressed, Packing::plain}) {
        Bytes file = seal(FileKind::lineage, random_bytes(301, 1), packing);
        for (std::size_t length = 0; length < file.size(); ++length)
            EXPECT_NE(refusal(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length))), "") << length;
        file.push_back(std::byte{0});
        EXPECT_THAT(refusal(file), HasSubstr("1 bytes too many"));
    }
}

TEST(Container, detects_a_flip_of_every_bit) {
    for (Packing packing : {Packing::compressed, Packing::plain}) {
        Bytes file = seal(FileKind::lineage, random_bytes(200, 1), packing);
        for (std::size_t bit = 0; bit < file.size() * 8; ++bit) {
            file[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
            EXPECT_NE(refusal(file), "") << bit;
            file[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        }
        EXPECT_EQ(refusal(file), "");
    }
}

TEST(Container, refuses_a_newer_version_politely) {
    Bytes file = seal(FileKind::lineage, random_bytes(10, 0));
    file[8] = std::byte{3};
    reseal(file);
    EXPECT_EQ(refusal(file),
              "cannot read some.lore (written by a newer Lore: format 3, this one reads 2). Update Lore.");
}

TEST(Container, says_the_version_of_its_format) {
    Bytes file = seal(FileKind::lineage, random_bytes(10, 0));
    EXPECT_EQ(unseal(file, FileKind::lineage, "x").version, container_version);
    file[8] = std::byte{1};
    reseal(file);
    EXPECT_EQ(unseal(file, FileKind::lineage, "x").version, 1u);
    EXPECT_EQ(container_length(file, "x"), file.size());
}

TEST(Container, refuses_another_kind_and_foreign_files) {
    EXPECT_THAT(refusal(seal(FileKind::checkpoint, random_bytes(10, 0))),
                HasSubstr("it is a checkpoint, not a lineage archive"));
    Bytes foreign(200, std::byte{'a'});
    EXPECT_THAT(refusal(foreign), HasSubstr("not a file of Lore"));
    EXPECT_THAT(refusal(Bytes{}), HasSubstr("empty"));
}

TEST(Container, allocates_nothing_for_a_forged_length) {
    constexpr std::size_t content = 5000;
    for (std::size_t offset : {24u, 32u})
        for (std::uint64_t length :
             {std::uint64_t{1} << 62, std::uint64_t{1} << 33, std::uint64_t{12345678}, std::uint64_t{0}}) {
            Bytes file = seal(FileKind::lineage, random_bytes(content, 1));
            std::memcpy(file.data() + offset, &length, sizeof length);
            reseal(file);
            take_largest_allocation();
            EXPECT_NE(refusal(file), "") << offset << " " << length;
            EXPECT_LE(take_largest_allocation(), content) << offset << " " << length;
        }
}

TEST(Container, allocates_nothing_for_a_few_bytes_that_claim_to_unpack_to_gigabytes) {
    // A zstd frame whose own header claims 2 GiB, as does Lore's: only their length gives them away.
    std::uint64_t const claimed = std::uint64_t{1} << 31;
    Bytes file = seal(FileKind::lineage, zstd_claiming(claimed), Packing::plain);
    std::uint32_t const flag_zstd = 1;
    std::memcpy(file.data() + 20, &flag_zstd, sizeof flag_zstd);
    std::memcpy(file.data() + 32, &claimed, sizeof claimed);
    reseal(file);
    take_largest_allocation();
    EXPECT_THAT(refusal(file), HasSubstr("does not have the length that the header states"));
    EXPECT_LT(take_largest_allocation(), 1000u);
}

TEST(Container, is_not_made_of_more_than_readers_unpack) {
    // Addresses without memory: whoever looks at the payload dies of it.
    std::size_t const size = (std::size_t{4} << 30) + 1;
    void* const nothing = ::mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    ASSERT_NE(nothing, MAP_FAILED);
    std::span<std::byte const> const payload{static_cast<std::byte const*>(nothing), size};
    for (Packing const packing : {Packing::compressed, Packing::fast})
        EXPECT_THAT(test::complaint_of([&] { seal(FileKind::lineage, payload, packing); }),
                    HasSubstr("a compressed one has at most 4"));
    ::munmap(nothing, size);
}

TEST(Container, unpacks_what_compresses_best) {
    Bytes const zeros(std::size_t{20} << 20);
    Bytes const file = seal(FileKind::lineage, zeros);
    EXPECT_LT(file.size(), 2000u);
    EXPECT_EQ(unseal(file, FileKind::lineage, "zeros").bytes, zeros);
}

TEST(Container, survives_a_damaged_compressed_part_behind_a_right_checksum) {
    Bytes const file = seal(FileKind::lineage, random_bytes(400, 1));
    for (std::size_t at = 64; at < file.size(); ++at) {
        Bytes changed = file;
        changed[at] ^= std::byte{0x41};
        reseal(changed);
        refusal(changed);   // an error or other bytes, but of the stated length
        try {
            EXPECT_EQ(unseal(changed, FileKind::lineage, "x").bytes.size(), 400u);
        } catch (Error const&) {}
    }
}

TEST(Container, maps_a_plain_payload_aligned_to_64_bytes_and_copies_a_compressed_one) {
    Scratch const scratch;
    Bytes const payload = random_bytes(5001, 1);
    for (Packing packing : {Packing::compressed, Packing::plain}) {
        write_container(scratch.file("a"), FileKind::knowledge_base, payload, packing);
        MappedPayload const mapped = map_container(scratch.file("a"), FileKind::knowledge_base);
        EXPECT_TRUE(std::equal(payload.begin(), payload.end(), mapped.bytes.begin(), mapped.bytes.end()));
        if (packing == Packing::plain) { EXPECT_EQ(reinterpret_cast<std::uintptr_t>(mapped.bytes.data()) % 64, 0u); }
        EXPECT_EQ(read_container(scratch.file("a"), FileKind::knowledge_base).bytes, payload);
        EXPECT_EQ(kind_of_file(scratch.file("a")), FileKind::knowledge_base);
    }
}

TEST(Container, written_in_pieces_is_the_file_that_is_sealed_whole) {
    Scratch const scratch;
    Bytes payload(1000);
    for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<std::byte>(i * 7);
    std::span<std::byte const> const whole{payload};
    std::array<std::span<std::byte const>, 4> const pieces{whole.first(1), whole.subspan(1, 0), whole.subspan(1, 700),
                                                           whole.subspan(701)};
    write_plain_container(scratch.file("pieces"), FileKind::knowledge_base, pieces);
    EXPECT_EQ(read_file(scratch.file("pieces")), seal(FileKind::knowledge_base, payload, Packing::plain));
}
