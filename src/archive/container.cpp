#include <lore/archive/container.h>

#include "zstd_frame.h"

#include <lore/core/input_file.h>

#include <fmt/format.h>
#include <xxhash.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/mman.h>
#include <unistd.h>

namespace lore {

namespace {

// As in PNG: a byte above 127, line ends and an end-of-file mark show up a transfer in text mode.
constexpr unsigned char magic[8]{0x89, 'L', 'O', 'R', 'E', '\r', '\n', 0x1a};
constexpr std::uint32_t byte_order_mark = 0x01020304;
constexpr std::uint32_t flag_zstd = 1;
constexpr std::uint64_t most_raw_bytes = std::uint64_t{4} << 30;   ///< no payload of Lore comes near it
constexpr int careful_level = 6, fast_level = 1;

/// The first 64 bytes of a file, in the machine's byte order, which byte_order gives away.
struct Header {
    unsigned char magic[8];
    std::uint32_t version;
    std::uint32_t byte_order;
    std::uint32_t kind;
    std::uint32_t flags;
    std::uint64_t stored_length;
    std::uint64_t raw_length;
    std::uint64_t reserved[2];
    std::uint64_t checksum;   ///< XXH3-64 of the header before this field and of the stored payload
};
static_assert(sizeof(Header) == container_header_size);

struct HashState {
    XXH3_state_t* state = XXH3_createState();
    ~HashState() { XXH3_freeState(state); }
};

std::uint64_t checksum_of(Header const& header, BytePieces stored) {
    HashState const hash;
    XXH3_64bits_reset(hash.state);
    XXH3_64bits_update(hash.state, &header, offsetof(Header, checksum));
    for (std::span<std::byte const> const piece : stored)
        if (!piece.empty()) XXH3_64bits_update(hash.state, piece.data(), piece.size());
    return XXH3_64bits_digest(hash.state);
}

[[noreturn]] void refuse(std::string_view name, std::string const& reason, std::string_view remedy) {
    throw Error(fmt::format("cannot read {}", name), reason, remedy);
}

constexpr std::string_view renew = "Take a copy that is whole, or make the file again.";

Header header_of(std::span<std::byte const> file, std::string_view name) {
    if (file.empty()) refuse(name, "the file is empty", renew);
    std::size_t const seen = std::min(file.size(), sizeof magic);
    if (std::memcmp(file.data(), magic, seen) != 0) refuse(name, "it is not a file of Lore", "Check the path.");
    if (file.size() < sizeof(Header)) refuse(name, "the file was cut inside its header", renew);
    Header header;
    std::memcpy(&header, file.data(), sizeof header);
    if (header.byte_order == __builtin_bswap32(byte_order_mark))
        refuse(name, "it was written on a machine of the other byte order", "Export it there as CSV or NPY.");
    if (header.byte_order != byte_order_mark) refuse(name, "its header was changed", renew);
    if (header.version > container_version)
        throw NewerFormat(
            fmt::format("cannot read {}", name),
            fmt::format("written by a newer Lore: format {}, this one reads {}", header.version, container_version),
            "Update Lore.");
    if (header.version == 0) refuse(name, "its header was changed", renew);
    return header;
}

Header new_header(FileKind kind, std::uint64_t raw_length) {
    Header header{};
    std::memcpy(header.magic, magic, sizeof magic);
    header.version = container_version;
    header.byte_order = byte_order_mark;
    header.kind = static_cast<std::uint32_t>(kind);
    header.raw_length = raw_length;
    return header;
}

/// The stored payload of a file whose header, length and checksum hold.
std::span<std::byte const> checked_payload(std::span<std::byte const> file, Header const& header, FileKind expected,
                                           std::string_view name) {
    auto const stored = file.subspan(sizeof(Header));
    if (header.stored_length > stored.size())
        refuse(name, fmt::format("the file was cut: {} bytes of {} are there", stored.size(), header.stored_length),
               renew);
    if (header.stored_length < stored.size())
        refuse(name, fmt::format("{} bytes too many follow its end", stored.size() - header.stored_length), renew);
    if (checksum_of(header, {&stored, 1}) != header.checksum)
        refuse(name, "checksum mismatch: the file was changed", renew);
    if (header.kind != static_cast<std::uint32_t>(expected))
        refuse(
            name,
            fmt::format("it is a {}, not a {}", lore::name(static_cast<FileKind>(header.kind)), lore::name(expected)),
            "Check the path.");
    bool const packed = (header.flags & flag_zstd) != 0;
    if ((header.flags & ~flag_zstd) != 0 || (!packed && header.raw_length != header.stored_length))
        refuse(name, "its header contradicts itself", renew);
    if (packed && (header.raw_length > most_raw_bytes || !may_unpack_to(stored, header.raw_length)))
        refuse(name, "its compressed part does not have the length that the header states", renew);
    return stored;
}

Bytes unpack(std::span<std::byte const> stored, Header const& header, std::string_view name) {
    if ((header.flags & flag_zstd) == 0) return Bytes(stored.begin(), stored.end());
    auto raw = unpack_frame(stored, header.raw_length);
    if (!raw) refuse(name, "its compressed part cannot be unpacked", renew);
    return std::move(*raw);
}

}   // namespace

std::string_view name(FileKind kind) {
    switch (kind) {
    case FileKind::lineage: return "lineage archive";
    case FileKind::checkpoint: return "checkpoint";
    case FileKind::knowledge_base: return "knowledge base";
    case FileKind::all_individuals: return "archive of all individuals";
    case FileKind::genome: return "single genome";
    case FileKind::founders: return "founders file";
    }
    return "file of unknown kind";
}

Bytes seal(FileKind kind, std::span<std::byte const> payload, Packing packing) {
    if (packing != Packing::plain && payload.size() > most_raw_bytes)
        throw Error(fmt::format("cannot write a {} of {} GiB", name(kind), payload.size() >> 30),
                    fmt::format("a compressed one has at most {}", most_raw_bytes >> 30), "Take fewer individuals.");
    Header header = new_header(kind, payload.size());
    Bytes file(sizeof(Header));
    if (packing != Packing::plain) {
        file.resize(sizeof(Header) + ZSTD_compressBound(payload.size()));
        std::size_t const packed =
            ZSTD_compress(file.data() + sizeof(Header), file.size() - sizeof(Header), payload.data(), payload.size(),
                          packing == Packing::fast ? fast_level : careful_level);
        if (!ZSTD_isError(packed) && packed < payload.size()) {
            header.flags = flag_zstd;
            file.resize(sizeof(Header) + packed);
        }
    }
    if (header.flags == 0) {
        file.resize(sizeof(Header));
        file.insert(file.end(), payload.begin(), payload.end());
    }
    auto const stored = std::span{std::as_const(file)}.subspan(sizeof(Header));
    header.stored_length = stored.size();
    header.checksum = checksum_of(header, {&stored, 1});
    std::memcpy(file.data(), &header, sizeof header);
    return file;
}

Payload unseal(std::span<std::byte const> file, FileKind expected, std::string_view name) {
    Header const header = header_of(file, name);
    return {unpack(checked_payload(file, header, expected, name), header, name), header.version};
}

std::uint64_t container_length(std::span<std::byte const> header, std::string_view name) {
    std::uint64_t const stored = header_of(header, name).stored_length;
    if (stored > UINT64_MAX - sizeof(Header)) refuse(name, "its header contradicts itself", renew);
    return sizeof(Header) + stored;
}

void write_container(std::string const& path, FileKind kind, std::span<std::byte const> payload, Packing packing) {
    if (packing == Packing::plain) return write_plain_container(path, kind, {&payload, 1});
    write_file_atomically(path, seal(kind, payload, packing));
}

void write_plain_container(std::string const& path, FileKind kind, BytePieces payload) {
    std::uint64_t length = 0;
    for (std::span<std::byte const> const piece : payload) length += piece.size();
    Header header = new_header(kind, length);
    header.stored_length = length;
    header.checksum = checksum_of(header, payload);
    std::vector<std::span<std::byte const>> file{std::as_bytes(std::span{&header, 1})};
    file.insert(file.end(), payload.begin(), payload.end());
    write_file_atomically(path, file);
}

Payload read_container(std::string const& path, FileKind expected) { return unseal(read_file(path), expected, path); }

MappedPayload map_container(std::string const& path, FileKind expected) {
    InputFile const file = open_input(path);
    if (!file.regular) {   // a pipe cannot be mapped
        auto const raw = std::make_shared<Bytes const>(unseal(read_bytes(file), expected, path).bytes);
        return {*raw, raw};
    }
    auto const length = static_cast<std::size_t>(file.size);
    if (length == 0) refuse(path, "the file is empty", renew);
    void* const address = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, file.descriptor.get(), 0);
    if (address == MAP_FAILED) throw file_error("read", path, errno);
    std::shared_ptr<void const> mapping{address,
                                        [length](void const* start) { ::munmap(const_cast<void*>(start), length); }};
    std::span<std::byte const> const bytes{static_cast<std::byte const*>(address), length};
    Header const header = header_of(bytes, path);
    auto const stored = checked_payload(bytes, header, expected, path);
    if ((header.flags & flag_zstd) == 0) return {stored, std::move(mapping)};
    auto const raw = std::make_shared<Bytes const>(unpack(stored, header, path));
    return {*raw, raw};
}

FileKind kind_of_file(std::string const& path) {
    InputFile const file = open_regular(path);
    std::byte start[sizeof(Header)];
    ssize_t const got = ::read(file.descriptor.get(), start, sizeof start);
    if (got < 0) throw file_error("read", path, errno);
    return static_cast<FileKind>(header_of({start, static_cast<std::size_t>(got)}, path).kind);
}

}   // namespace lore
