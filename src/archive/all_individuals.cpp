#include <lore/archive/all_individuals.h>

#include "boost_types.h"
#include "genome_difference.h"
#include "zstd_frame.h"

#include <lore/core/file.h>
#include <lore/core/input_file.h>

#include <fmt/format.h>
#include <xxhash.h>
#include <zstd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>

#include <fcntl.h>
#include <sys/stat.h>

namespace lore {

namespace {

constexpr std::uint32_t frame_mark = 0x4d415246;                     ///< "FRAM"
constexpr std::size_t frame_target = 256 * 1024;                     ///< gathered before a frame is written [bytes]
constexpr std::uint64_t most_frame_bytes = std::uint64_t{1} << 32;   ///< a generation is in one, however large
constexpr int zstd_level = 3;

struct FrameHeader {
    std::uint32_t mark;
    std::uint32_t generations;
    std::uint64_t raw_length;
    std::uint64_t stored_length;
    std::uint64_t
        checksum;   ///< XXH3-64 of the header before this field and of the stored bytes, seeded by the frame before
};

std::uint64_t checksum_of(FrameHeader const& header, std::span<std::byte const> stored, std::uint64_t former) {
    return XXH3_64bits_withSeed(stored.data(), stored.size(),
                                XXH3_64bits_withSeed(&header, offsetof(FrameHeader, checksum), former));
}

/// What both sides know of a possible parent.
struct Known {
    IndividualId id;
    Genome genome;
};
/// In order of birth; parents are named by their place.
using Pool = std::vector<Known>;

std::size_t place_of(Pool const& pool, IndividualId id) {
    auto const at = std::lower_bound(pool.begin(), pool.end(), id,
                                     [](Known const& known, IndividualId wanted) { return known.id < wanted; });
    assert(at != pool.end() && at->id == id);
    return static_cast<std::size_t>(at - pool.begin());
}

Pool pool_of(std::span<Individual const> members) {
    Pool pool;
    for (Individual const& member : members) pool.push_back({member.id(), member.birth->genome});
    std::sort(pool.begin(), pool.end(), [](Known const& a, Known const& b) { return a.id < b.id; });
    return pool;
}

/// The file's first bytes: a container with the world alone, so that kind and version are where every file of Lore has
/// them. That of version 1 is empty.
Bytes file_head(WorldRecord const& world) {
    Bytes const payload = write_with_boost([&](OutArchive& archive) { put_world(archive, world); });
    return seal(FileKind::all_individuals, payload, Packing::plain);
}
constexpr std::uint64_t longest_head = 1u << 20;

constexpr std::uint64_t most_in_short = std::uint64_t{1} << 30;

/// Whole rewards from 0 to 2^30 as one number, any other as a larger number and a double: frames of both format
/// versions are alike, so that a file of version 1 can grow on.
void put_reward(ByteWriter& out, double reward) {
    bool const is_short = std::trunc(reward) == reward && reward >= 0 && reward <= static_cast<double>(most_in_short);
    out.put_varint(is_short ? static_cast<std::uint64_t>(reward) : most_in_short + 1);
    if (!is_short) out.put(reward);
}
double get_reward(ByteReader& in) {
    std::size_t const number = in.get_count(most_in_short + 1);
    double const reward = number > most_in_short ? in.get<double>() : static_cast<double>(number);
    if (!std::isfinite(reward)) in.fail("a reward that no evaluation gives");
    return reward;
}

}   // namespace

struct AllIndividualsWriter::State {
    std::string path;
    FileDescriptor file;
    AllIndividualsMark at;   ///< its `gathered` is filled by mark()
    ByteWriter gathered;
    Pool pool;

    void write_frame() {
        if (at.generations == 0) return;
        Bytes const raw = gathered.take();
        gathered = {};
        Bytes frame(sizeof(FrameHeader) + ZSTD_compressBound(raw.size()));
        std::size_t const packed = ZSTD_compress(frame.data() + sizeof(FrameHeader), frame.size() - sizeof(FrameHeader),
                                                 raw.data(), raw.size(), zstd_level);
        assert(!ZSTD_isError(packed));
        frame.resize(sizeof(FrameHeader) + packed);
        FrameHeader header{frame_mark, at.generations, raw.size(), packed, 0};
        header.checksum = checksum_of(header, std::span{frame}.subspan(sizeof(FrameHeader)), at.chain);
        std::memcpy(frame.data(), &header, sizeof header);
        write_fully(file.get(), frame, path);
        at.bytes += frame.size();
        at.chain = header.checksum;
        at.generations = 0;
    }
};

AllIndividualsWriter::AllIndividualsWriter(std::string path, WorldRecord const& world)
    : state_(std::make_unique<State>()) {
    state_->path = std::move(path);
    state_->file = FileDescriptor{::open(state_->path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
    if (state_->file.get() < 0) throw file_error("write", state_->path, errno);
    Bytes const head = file_head(world);
    write_fully(state_->file.get(), head, state_->path);
    state_->at.bytes = head.size();
}

AllIndividualsWriter::AllIndividualsWriter(std::string path, AllIndividualsMark const& mark,
                                           Population const& population)
    : state_(std::make_unique<State>()) {
    state_->path = std::move(path);
    state_->file = FileDescriptor{::open(state_->path.c_str(), O_WRONLY | O_CLOEXEC)};
    if (state_->file.get() < 0) throw file_error("write", state_->path, errno);
    struct stat status {};
    if (::fstat(state_->file.get(), &status) != 0) throw file_error("write", state_->path, errno);
    if (static_cast<std::uint64_t>(status.st_size) < mark.bytes)
        throw Error(fmt::format("cannot go on with {}", state_->path),
                    fmt::format("it has {} bytes, but the checkpoint was made at {}", status.st_size, mark.bytes),
                    "Start the run anew in another directory.");
    if (::ftruncate(state_->file.get(), static_cast<off_t>(mark.bytes)) != 0 ||
        ::lseek(state_->file.get(), 0, SEEK_END) < 0)
        throw file_error("write", state_->path, errno);
    state_->at = mark;
    state_->gathered.put_all(std::span{mark.gathered});
    state_->pool = pool_of(population.members);
}

AllIndividualsWriter::~AllIndividualsWriter() = default;

void AllIndividualsWriter::add(GenerationReport const& report) {
    State& state = *state_;
    ByteWriter& out = state.gathered;
    out.put_varint(static_cast<std::uint64_t>(report.generation));
    out.put_varint(report.born.size());
    for (Individual const& child : report.born) {
        Birth const& birth = *child.birth;
        std::size_t const parent = birth.parent == nullptr ? state.pool.size() : place_of(state.pool, birth.parent->id);
        out.put_varint(parent);
        put_reward(out, birth.reward);
        Genome const nothing{birth.genome.interface};
        put_difference(out, birth.parent == nullptr ? nothing : state.pool[parent].genome, birth.genome);
    }
    // Who survives, as one bit for each of the former pool and the newborn, in order of birth.
    Pool next = pool_of(report.state->population.members);
    std::vector<std::uint8_t> mask((state.pool.size() + report.born.size() + 7) / 8);
    std::size_t place = 0, survivor = 0;
    auto const mark = [&](IndividualId id) {
        if (survivor < next.size() && next[survivor].id == id) {
            mask[place / 8] = static_cast<std::uint8_t>(mask[place / 8] | 1u << place % 8);
            ++survivor;
        }
        ++place;
    };
    for (Known const& known : state.pool) mark(known.id);
    for (Individual const& child : report.born) mark(child.id());
    assert(survivor == next.size());
    out.put_all(std::span{std::as_const(mask)});
    state.pool = std::move(next);
    ++state.at.generations;
    if (out.size() >= frame_target) state.write_frame();
}

AllIndividualsMark AllIndividualsWriter::mark() {
    sync_file(state_->file.get(), state_->path);
    AllIndividualsMark mark = state_->at;
    mark.gathered = state_->gathered.bytes();
    return mark;
}

void AllIndividualsWriter::finish() {
    state_->write_frame();
    sync_file(state_->file.get(), state_->path);
}

namespace {

/// Reads frame after frame.
class FrameReader {
public:
    explicit FrameReader(std::string const& path) : path_(path), file_(open_regular(path)), left_(file_.size) {
        Bytes head(std::min<std::uint64_t>(left_, container_header_size));
        read(head);
        std::uint64_t const length = container_length(head, path);
        if (length > longest_head || length - head.size() > left_) fail("the file was cut inside its head");
        head.resize(length);
        read(std::span{head}.subspan(container_header_size));
        Payload const payload = unseal(head, FileKind::all_individuals, path);
        read_with_boost(payload, path, [&](InArchive& archive) { world_ = get_world(archive); });
    }
    WorldRecord const& world() const { return world_; }
    bool at_end() const { return left_ == 0; }
    std::uint64_t bytes() const { return read_; }
    std::uint32_t generations() const { return header_.generations; }

    Bytes next() {
        if (left_ < sizeof(FrameHeader)) fail("the file was cut inside a frame's header");
        read({reinterpret_cast<std::byte*>(&header_), sizeof header_});
        if (header_.mark != frame_mark) fail("a frame does not begin where one should");
        if (header_.stored_length > left_) fail("the file was cut inside a frame");
        stored_.resize(header_.stored_length);
        read(stored_);
        if (checksum_of(header_, stored_, chain_) != header_.checksum)
            fail("checksum mismatch: a frame was changed or lost");
        chain_ = header_.checksum;
        if (header_.raw_length > most_frame_bytes || !may_unpack_to(stored_, header_.raw_length))
            fail("a frame does not have the length that its header states");
        auto raw = unpack_frame(stored_, header_.raw_length);
        if (!raw) fail("a frame cannot be unpacked");
        return std::move(*raw);
    }
    [[noreturn]] void fail(std::string_view reason) const {
        throw Error(fmt::format("cannot read {}", path_), fmt::format("{}, at byte {}", reason, read_),
                    "Take a copy that is whole, or run the experiment again.");
    }

private:
    void read(std::span<std::byte> wanted) {
        while (!wanted.empty()) {
            ssize_t const got = ::read(file_.descriptor.get(), wanted.data(), wanted.size());
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) throw file_error("read", path_, errno);
            if (got == 0) fail("the file was cut while it was read");
            wanted = wanted.subspan(static_cast<std::size_t>(got));
            left_ -= static_cast<std::uint64_t>(got);
            read_ += static_cast<std::uint64_t>(got);
        }
    }

    std::string path_;
    InputFile file_;
    std::uint64_t left_ = 0, read_ = 0, chain_ = 0;
    FrameHeader header_{};
    Bytes stored_;
    WorldRecord world_;
};

/// Follows the generations of a file; the pool is all it remembers.
class Replay {
public:
    explicit Replay(std::string const& path) : name_(path), frames_(path) {}

    /// Reads on through generation `through`, or to the end where it is absent.
    void run(std::optional<int> through, std::function<void(ArchivedIndividual const&)> const& visit) {
        while (!frames_.at_end() && (!through || next_generation_ <= *through)) {
            Bytes const frame = frames_.next();
            ByteReader in{frame, name_};
            for (std::uint32_t g = 0; g < frames_.generations() && (!through || next_generation_ <= *through); ++g)
                generation(in, visit);
            if (!through || next_generation_ <= *through) in.expect_end();
        }
        if (through && next_generation_ <= *through)
            frames_.fail(fmt::format("the file ends with generation {}, but the run has reached {}",
                                     next_generation_ - 1, *through));
    }
    AllIndividualsSummary summary() const { return {next_generation_, individuals_, frames_.bytes(), frames_.world()}; }

private:
    void generation(ByteReader& in, std::function<void(ArchivedIndividual const&)> const& visit) {
        Genome const nothing{frames_.world().interface()};
        constexpr std::size_t most_born = 1u << 20;
        if (in.get_varint() != static_cast<std::uint64_t>(next_generation_)) in.fail("a generation is missing");
        std::size_t const parents = pool_.size();
        std::size_t const born = in.get_count(most_born);
        for (std::size_t slot = 0; slot < born; ++slot) {
            std::size_t const parent = in.get_count(parents);
            bool const orphan = parent == parents;
            double const reward = get_reward(in);
            Known child{{static_cast<std::uint32_t>(next_generation_), static_cast<std::uint32_t>(slot)},
                        get_difference(in, orphan ? nothing : pool_[parent].genome)};
            pool_.push_back(std::move(child));
            visit({pool_.back().id, orphan ? std::nullopt : std::optional{pool_[parent].id}, pool_.back().genome,
                   reward});
        }
        auto const mask = in.get_all<std::uint8_t>((pool_.size() + 7) / 8);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < pool_.size(); ++i) {
            if ((mask[i / 8] >> i % 8 & 1) == 0) continue;
            if (kept != i) pool_[kept] = std::move(pool_[i]);
            ++kept;
        }
        pool_.resize(kept);
        individuals_ += born;
        ++next_generation_;
    }

    std::string name_;
    FrameReader frames_;
    Pool pool_;
    int next_generation_ = 0;
    std::uint64_t individuals_ = 0;
};

}   // namespace

void for_each_individual(std::string const& path, int through,
                         std::function<void(ArchivedIndividual const&)> const& visit) {
    Replay{path}.run(through, visit);
}

AllIndividualsSummary check_all_individuals(std::string const& path) {
    Replay replay{path};
    replay.run(std::nullopt, [](ArchivedIndividual const&) {});
    return replay.summary();
}

}   // namespace lore
