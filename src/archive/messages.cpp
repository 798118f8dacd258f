#include <lore/archive/messages.h>

#include "byte_stream.h"
#include "channel_words.h"
#include "edge_bytes.h"
#include "field_limits.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace lore {

namespace {

constexpr std::size_t most_batch = 1u << 20;

using Words = std::vector<std::uint16_t>;   ///< Descriptors::channel_bits

/// A field of an evaluation: words of steps by what changes (channel_words.h), other vectors with their count before
/// them, all else as it lies in memory.
template <class Field>
void put_field(ByteWriter& out, Field const& field, int words_a_step) {
    if constexpr (std::is_same_v<Field, Words>) put_channel_words(out, field, words_a_step);
    else if constexpr (Flat<Field>) out.put(field);
    else {
        out.put_varint(field.size());
        out.put_all(std::span{field});
    }
}
template <class Field>
void get_field(ByteReader& in, Field& field) {
    if constexpr (std::is_same_v<Field, Words>) get_channel_words(in, field);
    else if constexpr (Flat<Field>) field = in.get<Field>();
    else {
        using Item = typename Field::value_type;
        field = in.get_all<Item>(in.get_count(most_items<Item>));
    }
}

/// Calls `visit` with every field of an Evaluation and of its Descriptors, in the order in which they are sent.
template <class AnyEvaluation, class Visit>
void visit_fields(AnyEvaluation& evaluation, Visit const& visit) {
    auto& [reward, shaping, shown, descriptors] = evaluation;   // does not compile while one is missing
    visit(reward);
    visit(shaping);
    visit(shown);
    for_each_field(descriptors, visit);
}

void put_delivery(ByteWriter& out, Delivery const& delivery) {
    auto const& [ticket, evaluation] = delivery;
    out.put_varint(static_cast<std::uint64_t>(ticket));
    int const words_a_step = evaluation.descriptors.words();
    visit_fields(evaluation, [&](auto const& field) { put_field(out, field, words_a_step); });
}

/// Calls `visit` with what distances of this kind compare.
template <class AnyDescriptors, class Visit>
void visit_compared(DistanceKind kind, AnyDescriptors& descriptors, Visit const& visit) {
    switch (kind) {
    case DistanceKind::adhoc: return visit(descriptors.outcome);
    case DistanceKind::hamming: visit(descriptors.channel_bits); [[fallthrough]];   // and how many channels there are
    case DistanceKind::entropy: return visit(descriptors.entropies);
    case DistanceKind::trajectory: return visit(descriptors.path);
    default: return for_each_field(descriptors, visit);
    }
}

/// What the fast distances rely on.
bool comparable(Descriptors const& a, Descriptors const& b) {
    auto const is_tile = [](Tile tile) { return tile.x < tiles_per_side && tile.y < tiles_per_side; };
    std::size_t const words = static_cast<std::size_t>(std::max(1, a.words()));
    return a.outcome.size() == b.outcome.size() && a.channels() == b.channels() && a.channel_bits.size() % words == 0 &&
           std::all_of(a.path.begin(), a.path.end(), is_tile);
}

}   // namespace

Bytes pack_genomes(std::span<Genome const* const> genomes) {
    ByteWriter out;
    out.put_varint(genomes.size());
    out.put(genomes.empty() ? Interface{} : genomes.front()->interface);
    for (Genome const* genome : genomes) {
        out.put_varint(genome->edges.size());
        out.put_varint(genome->biases.size());
        for (Edge const& edge : genome->edges) out.put(EdgeBytes{edge});
        out.put_all(std::span{genome->biases});
    }
    return out.take();
}

std::vector<Genome> unpack_genomes(std::span<std::byte const> bytes) {
    ByteReader in{bytes, "a message with genomes"};
    std::vector<Genome> genomes(in.get_count(std::min(most_batch, bytes.size())));
    auto const interface = in.get<Interface>();
    if (interface.inputs > most_sensors || interface.outputs > most_effectors) in.fail("an interface of no world");
    for (Genome& genome : genomes) {
        genome.interface = interface;
        genome.edges.resize(in.get_count(most_edges));
        std::size_t const biases = in.get_count(interface.outputs + std::size_t{most_hidden});
        for (Edge& edge : genome.edges) edge = in.get<EdgeBytes>().edge();
        genome.biases = in.get_all<float>(biases);
        if (std::string const why = why_invalid(genome); !why.empty()) in.fail("an invalid genome: " + why);
    }
    in.expect_end();
    return genomes;
}

Bytes pack_deliveries(std::span<Delivery const> deliveries) {
    ByteWriter out;
    out.put_varint(deliveries.size());
    for (Delivery const& delivery : deliveries) put_delivery(out, delivery);
    return out.take();
}

std::vector<Bytes> pack_deliveries(std::span<Delivery const> deliveries, std::size_t longest) {
    constexpr std::size_t count_bytes = 3;   // at most, of up to two million deliveries
    ByteWriter all;
    std::vector<std::size_t> ends{0};   // of the deliveries in it
    for (Delivery const& delivery : deliveries) {
        put_delivery(all, delivery);
        ends.push_back(all.size());
    }
    std::vector<Bytes> messages;
    for (std::size_t first = 0; first < deliveries.size();) {
        std::size_t last = first + 1;
        while (last < deliveries.size() && count_bytes + ends[last + 1] - ends[first] <= longest) ++last;
        std::size_t const bytes = ends[last] - ends[first];
        ByteWriter out;
        out.reserve(count_bytes + bytes + room_for_trailer);
        out.put_varint(last - first);
        out.put_all(std::span{all.bytes()}.subspan(ends[first], bytes));
        messages.push_back(out.take());
        first = last;
    }
    return messages;
}

std::vector<Delivery> unpack_deliveries(std::span<std::byte const> bytes) {
    ByteReader in{bytes, "a message with evaluations"};
    std::vector<Delivery> deliveries(in.get_count(std::min(most_batch, bytes.size())));
    for (auto& [ticket, evaluation] : deliveries) {
        ticket = static_cast<int>(in.get_count(std::numeric_limits<int>::max()));
        visit_fields(evaluation, [&](auto& field) { get_field(in, field); });
    }
    in.expect_end();
    return deliveries;
}

Bytes pack_pool(DistanceKind kind, int known, std::span<Descriptors const* const> members) {
    ByteWriter out;
    out.put_varint(static_cast<std::uint64_t>(kind));
    out.put_varint(static_cast<std::uint64_t>(known));
    out.put_varint(members.size());
    for (Descriptors const* member : members)
        visit_compared(kind, *member, [&](auto const& field) { put_field(out, field, member->words()); });
    return out.take();
}

void unpack_pool(std::span<std::byte const> bytes, ComparedPool& pool) {
    ByteReader in{bytes, "a message with descriptors"};
    DistanceKind const before = pool.kind;
    pool.kind = static_cast<DistanceKind>(in.get_count(distance_kinds - 1));
    std::size_t const known = in.get_count(most_batch);
    if (pool.kind != before) pool.members.clear();
    pool.members.resize(in.get_count(std::min(most_batch, bytes.size())));
    for (Descriptors& member : pool.members) {
        visit_compared(pool.kind, member, [&](auto& field) { get_field(in, field); });
        if (!comparable(member, pool.members[0])) in.fail("robots of different worlds");
    }
    if (known > pool.members.size()) in.fail("it knows more robots than there are");
    pool.known = static_cast<int>(known);
    in.expect_end();
}

Bytes pack_distances(std::span<double const> distances) {
    ByteWriter out;
    out.reserve(distances.size_bytes() + room_for_trailer);
    out.put_all(distances);
    return out.take();
}

void unpack_distances(std::span<std::byte const> bytes, std::span<double> distances) {
    ByteReader in{bytes, "a message with distances"};
    in.get_into(distances);
    in.expect_end();
}

}   // namespace lore
