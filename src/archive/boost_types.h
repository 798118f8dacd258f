#pragma once

// How Boost.Serialization sees Lore's types: the one door to <boost/...>. No type knows that it can be written.
//
// Arrays travel as blobs. A count is checked against its limit and against the bytes that are left before memory is
// taken for it, since Boost itself believes what it reads.

#include "byte_stream.h"
#include "edge_bytes.h"
#include "field_limits.h"
#include "version_1.h"

#include <lore/archive/container.h>
#include <lore/archive/world_record.h>
#include <lore/core/error.h>
#include <lore/evolution/individual.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/binary_object.hpp>
#include <boost/serialization/level.hpp>
#include <boost/serialization/split_free.hpp>
#include <boost/serialization/tracking.hpp>

#include <fmt/format.h>

#include <cstring>
#include <streambuf>
#include <string>
#include <stdexcept>
#include <type_traits>

namespace lore {

/// Grows a vector of bytes; what Boost writes goes there without a stringstream's copies.
class ByteSink : public std::streambuf {
public:
    Bytes bytes;

protected:
    std::streamsize xsputn(char const* data, std::streamsize count) override {
        auto const* const first = reinterpret_cast<std::byte const*>(data);
        bytes.insert(bytes.end(), first, first + count);
        return count;
    }
    int_type overflow(int_type c) override {
        bytes.push_back(static_cast<std::byte>(c));
        return c;
    }
};

class ByteSource : public std::streambuf {
public:
    explicit ByteSource(std::span<std::byte const> bytes) {
        char* const first = const_cast<char*>(reinterpret_cast<char const*>(bytes.data()));
        setg(first, first, first + bytes.size());
    }
    std::size_t left() const { return static_cast<std::size_t>(egptr() - gptr()); }
};

/// Without Boost's own header: the container has ours, and Boost would believe the lengths in its own.
class OutArchive : public boost::archive::binary_oarchive {
public:
    explicit OutArchive(ByteSink& sink) : binary_oarchive(sink, boost::archive::no_header) {}
};

/// Boost's archive, how much is left to read, and what the rest is: its format version and its world.
class InArchive : public boost::archive::binary_iarchive {
public:
    InArchive(ByteSource& source, std::uint32_t version)
        : binary_iarchive(source, boost::archive::no_header), source_(&source), version_(version) {}
    std::size_t left() const { return source_->left(); }
    std::uint32_t version() const { return version_; }
    /// Of the genomes that follow; none before a world is set.
    Interface interface() const { return interface_; }
    void set_world(WorldRecord const& world) { interface_ = world.interface(); }
    [[noreturn]] void fail(std::string const& reason) const { throw std::out_of_range(reason); }
    /// Boost hands our load functions its own type; every archive that Lore reads from is one of these.
    static InArchive& from(boost::archive::binary_iarchive& archive) { return static_cast<InArchive&>(archive); }

private:
    ByteSource* source_;
    std::uint32_t version_;
    Interface interface_;
};

/// Reads `payload` by `read(archive)`; Boost's and our complaints become one Error about `name`.
template <class Read>
void read_with_boost(Payload const& payload, std::string_view name, Read const& read) {
    std::string reason;
    try {
        ByteSource source{payload.bytes};
        InArchive archive{source, payload.version};
        read(archive);
        if (archive.left() != 0) archive.fail("more follows than expected");
        return;
    } catch (boost::archive::archive_exception const& error) {
        reason = error.what();
    } catch (std::out_of_range const& error) { reason = error.what(); } catch (std::length_error const&) {
        reason = "a length is out of range";
    }
    throw Error(fmt::format("cannot read {}", name), reason, "Take a copy that is whole, or make the file again.");
}

template <class Write>
Bytes write_with_boost(Write const& write) {
    ByteSink sink;
    {
        OutArchive archive{sink};
        write(archive);
    }
    return std::move(sink.bytes);
}

/// A vector of plain values as a count and one blob.
template <class T>
void put_blob(boost::archive::binary_oarchive& archive, std::vector<T> const& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::uint64_t const count = values.size();
    archive << count;
    if (count != 0) archive.save_binary(values.data(), values.size() * sizeof(T));
}
template <class T>
void get_blob(InArchive& archive, std::vector<T>& values, std::size_t most) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::uint64_t count = 0;
    archive >> count;
    if (count > most || count > archive.left() / sizeof(T)) archive.fail("a count is out of range");
    values.resize(static_cast<std::size_t>(count));
    if (count != 0) archive.load_binary(values.data(), values.size() * sizeof(T));
}
inline void put_text(boost::archive::binary_oarchive& archive, std::string_view text) {
    put_blob(archive, std::vector<char>(text.begin(), text.end()));
}
inline std::string get_text(InArchive& archive, std::size_t longest) {
    std::vector<char> text;
    get_blob(archive, text, longest);
    return {text.begin(), text.end()};
}
/// The world, with which every payload begins. One of version 1 does not, and is of the world that version 1 knows.
inline void put_world(OutArchive& archive, WorldRecord const& world) { put_text(archive, to_json(world)); }
inline WorldRecord get_world(InArchive& archive) {
    constexpr std::size_t longest_record = 1u << 20;
    WorldRecord world =
        archive.version() == 1 ? world_of_version_1() : parse_world_record(get_text(archive, longest_record));
    if (world.channels.count() == 0) archive.fail("its world has no channels");
    archive.set_world(world);
    return world;
}
/// A reward: a double; of version 1 an integer.
inline void put_reward(OutArchive& archive, double reward) { archive << reward; }
inline double get_reward(InArchive& archive) {
    double reward = 0;
    if (archive.version() == 1) {
        std::int32_t whole = 0;
        archive >> whole;
        reward = whole;
    } else archive >> reward;
    return reward;
}

/// A count of things that take at least `least_bytes` each.
inline std::size_t get_count(InArchive& archive, std::size_t least_bytes) {
    std::uint64_t count = 0;
    archive >> count;
    if (count > archive.left() / least_bytes) archive.fail("a count is out of range");
    return static_cast<std::size_t>(count);
}

/// The fields of Descriptors: vectors as blobs, all else as it lies in memory.
template <class T>
void put_field(boost::archive::binary_oarchive& archive, std::vector<T> const& items) {
    put_blob(archive, items);
}
template <class T>
void get_field(InArchive& archive, std::vector<T>& items) {
    get_blob(archive, items, most_items<T>);
}
template <Flat T>
void put_field(boost::archive::binary_oarchive& archive, T const& value) {
    archive.save_binary(&value, sizeof value);
}
template <Flat T>
void get_field(InArchive& archive, T& value) {
    archive.load_binary(&value, sizeof value);
}

}   // namespace lore

namespace boost::serialization {

inline void save(boost::archive::binary_oarchive& archive, lore::Genome const& genome, unsigned) {
    std::vector<lore::EdgeBytes> const edges(genome.edges.begin(), genome.edges.end());
    lore::put_blob(archive, edges);
    lore::put_blob(archive, genome.biases);
}
inline void load(boost::archive::binary_iarchive& any, lore::Genome& genome, unsigned) {
    auto& archive = lore::InArchive::from(any);
    genome.interface = archive.interface();
    std::vector<lore::EdgeBytes> edges;
    lore::get_blob(archive, edges, lore::most_edges);
    lore::get_blob(archive, genome.biases, genome.interface.outputs + std::size_t{lore::most_hidden});
    genome.edges.resize(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) genome.edges[i] = edges[i].edge();
    if (std::string const why = lore::why_invalid(genome); !why.empty()) archive.fail("an invalid genome: " + why);
}

template <class Archive>
void serialize(Archive& archive, lore::IndividualId& id, unsigned) {
    archive& id.generation& id.slot;
}

inline void save(boost::archive::binary_oarchive& archive, lore::Descriptors const& descriptors, unsigned) {
    lore::for_each_field(descriptors, [&](auto const& field) { lore::put_field(archive, field); });
}
inline void load(boost::archive::binary_iarchive& any, lore::Descriptors& descriptors, unsigned) {
    auto& archive = lore::InArchive::from(any);
    if (archive.version() == 1) return lore::get_descriptors_of_version_1(archive, descriptors);
    lore::for_each_field(descriptors, [&](auto& field) { lore::get_field(archive, field); });
}

}   // namespace boost::serialization

BOOST_SERIALIZATION_SPLIT_FREE(lore::Genome)
BOOST_SERIALIZATION_SPLIT_FREE(lore::Descriptors)
// The container's format version covers all of them; Boost's own class versions and tracking would only take space.
BOOST_CLASS_IMPLEMENTATION(lore::Genome, boost::serialization::object_serializable)
BOOST_CLASS_IMPLEMENTATION(lore::Descriptors, boost::serialization::object_serializable)
BOOST_CLASS_IMPLEMENTATION(lore::IndividualId, boost::serialization::object_serializable)
BOOST_CLASS_TRACKING(lore::Genome, boost::serialization::track_never)
BOOST_CLASS_TRACKING(lore::Descriptors, boost::serialization::track_never)
BOOST_CLASS_TRACKING(lore::IndividualId, boost::serialization::track_never)
