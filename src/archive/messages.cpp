#include <lore/archive/messages.h>

#include "byte_stream.h"
#include "edge_bytes.h"
#include "field_limits.h"

#include <cstring>
#include <limits>
#include <type_traits>

namespace lore {

namespace {

constexpr std::size_t most_batch = 1u << 20;
constexpr std::size_t longest_evaluation = 1u << 24;            ///< words; runs could claim any number of them
constexpr std::size_t most_words = (most_channels + 15) / 16;   ///< a step

/// The first place after `first`, whole steps away, with another step than that at `first`, or the end. A step has so
/// many words.
std::size_t end_of_run(std::span<std::uint16_t const> words, std::size_t first, std::size_t in_a_step) {
    constexpr std::size_t at_once = 16;   // one comparison in long runs
    std::size_t end = first + in_a_step;
    while (end + at_once <= words.size() &&
           std::memcmp(&words[end], &words[end - in_a_step], at_once * sizeof(std::uint16_t)) == 0)
        end += at_once;
    while (end < words.size() && words[end] == words[end - in_a_step]) ++end;
    return end - (end - first) % in_a_step;
}

/// Most steps repeat the one before: as runs they take a tenth. Written out where that is shorter.
void put_words(ByteWriter& out, std::vector<std::uint16_t> const& words, int words_a_step) {
    std::size_t in_a_step = static_cast<std::size_t>(std::max(1, words_a_step));
    if (words.size() % in_a_step != 0) in_a_step = 1;
    ByteWriter runs;
    for (std::size_t i = 0; i < words.size();) {
        std::size_t const end = end_of_run(words, i, in_a_step);
        runs.put_varint((end - i) / in_a_step);
        runs.put_all(std::span{words}.subspan(i, in_a_step));
        i = end;
    }
    bool const as_runs = runs.size() < words.size() * sizeof(std::uint16_t);
    out.put(static_cast<std::uint8_t>(as_runs ? in_a_step : 0));
    out.put_varint(words.size());
    if (as_runs) out.put_all(std::span{runs.bytes()});
    else out.put_all(std::span{words});
}

std::vector<std::uint16_t> get_words(ByteReader& in) {
    std::size_t const in_a_step = in.get<std::uint8_t>();   // 0: written out
    std::size_t const count = in.get_count(longest_evaluation);
    if (in_a_step == 0) return in.get_all<std::uint16_t>(count);
    if (in_a_step > most_words || count % in_a_step != 0) in.fail("steps of no world");
    std::vector<std::uint16_t> words;
    words.reserve(count);
    while (words.size() < count) {
        std::size_t const run = in.get_count((count - words.size()) / in_a_step);
        if (run == 0) in.fail("a run of no length");
        auto const step = in.get_all<std::uint16_t>(in_a_step);
        if (in_a_step == 1) words.insert(words.end(), run, step[0]);
        else
            for (std::size_t i = 0; i < run; ++i) words.insert(words.end(), step.begin(), step.end());
    }
    return words;
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

/// Descriptors::channel_bits.
template <class Field>
inline constexpr bool is_words = std::is_same_v<std::remove_cvref_t<Field>, std::vector<std::uint16_t>>;

/// Calls `visit` with every field of an Evaluation and of its Descriptors, in the order in which they are sent.
template <class AnyEvaluation, class Visit>
void visit_fields(AnyEvaluation& evaluation, Visit const& visit) {
    auto& [reward, shaping, shown, descriptors] = evaluation;   // does not compile while one is missing
    visit(reward);
    visit(shaping);
    visit(shown);
    for_each_field(descriptors, visit);
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
    }
    in.expect_end();
    return genomes;
}

Bytes pack_deliveries(std::span<Delivery const> deliveries) {
    ByteWriter out;
    out.put_varint(deliveries.size());
    for (auto const& [ticket, evaluation] : deliveries) {
        out.put_varint(static_cast<std::uint64_t>(ticket));
        int const words_a_step = evaluation.descriptors.words();
        visit_fields(evaluation, [&](auto const& field) {
            if constexpr (is_words<decltype(field)>) put_words(out, field, words_a_step);
            else put_field(out, field);
        });
    }
    return out.take();
}

std::vector<Delivery> unpack_deliveries(std::span<std::byte const> bytes) {
    ByteReader in{bytes, "a message with evaluations"};
    std::vector<Delivery> deliveries(in.get_count(std::min(most_batch, bytes.size())));
    for (auto& [ticket, evaluation] : deliveries) {
        ticket = static_cast<int>(in.get_count(std::numeric_limits<int>::max()));
        visit_fields(evaluation, [&](auto& field) {
            if constexpr (is_words<decltype(field)>) field = get_words(in);
            else get_field(in, field);
        });
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
