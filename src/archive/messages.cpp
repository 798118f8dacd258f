#include <lore/archive/messages.h>

#include "byte_stream.h"
#include "edge_bytes.h"
#include "field_limits.h"

#include <cstring>
#include <limits>

namespace lore {

namespace {

constexpr std::size_t most_batch = 1u << 20;
constexpr std::size_t longest_evaluation = 1u << 24;   ///< steps; runs could claim any number of them

/// The first place after `first` with another word, or the end.
std::size_t end_of_run(std::span<std::uint16_t const> words, std::size_t first) {
    constexpr std::size_t at_once = 16;   // one comparison in long runs
    std::size_t end = first + 1;
    while (end + at_once <= words.size() &&
           std::memcmp(&words[end], &words[end - 1], at_once * sizeof(std::uint16_t)) == 0)
        end += at_once;
    while (end < words.size() && words[end] == words[first]) ++end;
    return end;
}

/// Words of consecutive steps are mostly equal: as runs they take a tenth. Written out where that is shorter.
void put_field(ByteWriter& out, std::vector<std::uint16_t> const& words) {
    ByteWriter runs;
    for (std::size_t i = 0; i < words.size();) {
        std::size_t const end = end_of_run(words, i);
        runs.put_varint(end - i);
        runs.put(words[i]);
        i = end;
    }
    bool const as_runs = runs.size() < words.size() * sizeof(std::uint16_t);
    out.put(static_cast<std::uint8_t>(as_runs));
    out.put_varint(words.size());
    if (as_runs) out.put_all(std::span{runs.bytes()});
    else out.put_all(std::span{words});
}

void get_field(ByteReader& in, std::vector<std::uint16_t>& words) {
    bool const as_runs = in.get<std::uint8_t>() != 0;
    std::size_t const count = in.get_count(longest_evaluation);
    if (!as_runs) {
        words = in.get_all<std::uint16_t>(count);
        return;
    }
    words.reserve(count);
    while (words.size() < count) {
        std::size_t const run = in.get_count(count - words.size());
        if (run == 0) in.fail("a run of no length");
        words.insert(words.end(), run, in.get<std::uint16_t>());
    }
}

/// Other fields of evaluations: vectors with their count before them, all else as it lies in memory.
template <class T>
void put_field(ByteWriter& out, std::vector<T> const& items) {
    out.put_varint(items.size());
    out.put_all(std::span{items});
}
template <class T>
void get_field(ByteReader& in, std::vector<T>& items) {
    items = in.get_all<T>(in.get_count(most_items<T>));
}
template <Flat T>
void put_field(ByteWriter& out, T const& value) {
    out.put(value);
}
template <Flat T>
void get_field(ByteReader& in, T& value) {
    value = in.get<T>();
}

/// Calls `visit` with every field of an Evaluation and of its Descriptors, in the order in which they are sent.
template <class AnyEvaluation, class Visit>
void visit_fields(AnyEvaluation& evaluation, Visit const& visit) {
    auto& [balls, shaping, shown, descriptors] = evaluation;   // does not compile while one is missing
    visit(balls);
    visit(shaping);
    visit(shown);
    for_each_field(descriptors, visit);
}

}   // namespace

Bytes pack_genomes(std::span<Genome const* const> genomes) {
    ByteWriter out;
    out.put_varint(genomes.size());
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
    for (Genome& genome : genomes) {
        genome.edges.resize(in.get_count(most_edges));
        std::size_t const biases = in.get_count(effector_count + most_hidden);
        for (Edge& edge : genome.edges) edge = in.get<EdgeBytes>().edge();
        genome.biases = in.get_all<float>(biases);
    }
    in.expect_end();
    return genomes;
}

Bytes pack_deliveries(std::span<Delivery const> deliveries) {
    ByteWriter out;
    out.put_varint(deliveries.size());
    for (auto const& [ticket, evaluation] : deliveries) {
        out.put_varint(static_cast<std::uint64_t>(ticket));
        visit_fields(evaluation, [&](auto const& field) { put_field(out, field); });
    }
    return out.take();
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

Bytes pack_rows(int first, int last, std::span<Descriptors const* const> pool) {
    ByteWriter out;
    out.put(std::int32_t{first});
    out.put(std::int32_t{last});
    for (Descriptors const* member : pool.first(static_cast<std::size_t>(last))) {
        out.put_varint(member->path.size());
        out.put_all(std::span{member->path});
    }
    return out.take();
}

RowRequest unpack_rows(std::span<std::byte const> bytes) {
    ByteReader in{bytes, "a message with paths"};
    RowRequest request;
    request.first = in.get<std::int32_t>();
    request.last = in.get<std::int32_t>();
    if (request.first < 0 || request.last < request.first || static_cast<std::size_t>(request.last) > bytes.size())
        in.fail("its rows are out of range");
    request.pool.resize(static_cast<std::size_t>(request.last));
    for (Descriptors& member : request.pool) member.path = in.get_all<Tile>(in.get_count(bytes.size()));
    in.expect_end();
    return request;
}

Bytes pack_distances(int first, int last, DistanceMatrix const& matrix) {
    ByteWriter out;
    for (int i = first; i < last; ++i)
        for (int j = 0; j < i; ++j) out.put(matrix(i, j));
    return out.take();
}

void unpack_distances(std::span<std::byte const> bytes, int first, int last, DistanceMatrix& matrix) {
    ByteReader in{bytes, "a message with distances"};
    for (int i = first; i < last; ++i)
        for (int j = 0; j < i; ++j) matrix.set(i, j, in.get<double>());
    in.expect_end();
}

}   // namespace lore
