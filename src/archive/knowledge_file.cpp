#include <lore/archive/knowledge_file.h>

#include <lore/archive/container.h>
#include <lore/archive/knowledge_export.h>
#include <lore/core/error.h>
#include <lore/core/whole_number.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

constexpr std::uint32_t layout_version = 1;
constexpr std::uint64_t alignment = 64;
constexpr std::uint64_t most_features = 1u << 30;   ///< a feature's number is an int

/// The first bytes of the payload. The arrays follow in the order of Layout, the provenance as JSON at the end.
struct Preamble {
    std::uint32_t layout;
    std::uint32_t window_length;
    float match_threshold;
    std::uint32_t binary_channels;
    std::uint32_t continuous_channels;
    std::uint32_t reserved;
    std::uint64_t features;
    std::uint64_t provenance_length;
    std::uint64_t padding[3];
};
static_assert(sizeof(Preamble) == alignment && container_header_size % alignment == 0);

/// Where each array starts in the payload [bytes].
struct Layout {
    std::uint64_t values, reward_sums, counts, windows, bits, provenance, end;

    Layout(std::uint64_t features, std::uint64_t steps, std::uint64_t provenance_length) {
        std::uint64_t at = sizeof(Preamble);
        auto const take = [&at](std::uint64_t bytes) {
            std::uint64_t const start = at;
            at = (at + bytes + alignment - 1) / alignment * alignment;
            return start;
        };
        values = take(features * sizeof(double));
        reward_sums = take(features * sizeof(double));
        counts = take(features * sizeof(std::uint32_t));
        windows = take(features * steps * continuous_count * sizeof(float));
        bits = take(features * steps * sizeof(std::uint16_t));
        provenance = at;
        end = at + provenance_length;
    }
};

Provenance provenance_of(std::string_view text) {
    auto const json = nlohmann::json::parse(text);
    Provenance provenance;
    json.at("made_by").get_to(provenance.made_by);
    json.at("kind").get_to(provenance.kind);
    json.at("index").get_to(provenance.index);
    json.at("sources").get_to(provenance.sources);
    json.at("derivation").get_to(provenance.derivation);
    json.at("task").get_to(provenance.task);
    provenance.individuals = whole_number<std::uint64_t>(json.at("individuals"));
    provenance.windows = whole_number<std::uint64_t>(json.at("windows"));
    provenance.best_balls = whole_number<int>(json.at("best_balls"));
    return provenance;
}

/// The payload as pieces: arrays where they are, zeros between them.
class PayloadPieces {
public:
    template <class T>
    void place(std::uint64_t at, std::span<T const> items) {
        assert(at >= length_ && at - length_ < alignment);
        static constexpr std::byte zeros[alignment]{};
        pieces_.push_back({zeros, static_cast<std::size_t>(at - length_)});
        pieces_.push_back(std::as_bytes(items));
        length_ = at + items.size_bytes();
    }
    BytePieces pieces() const { return pieces_; }

private:
    std::vector<std::span<std::byte const>> pieces_;
    std::uint64_t length_ = 0;
};

template <class T>
std::span<T const> view(std::span<std::byte const> payload, std::uint64_t at, std::uint64_t count) {
    return {reinterpret_cast<T const*>(payload.data() + at), static_cast<std::size_t>(count)};
}

[[noreturn]] void refuse(std::string const& path, std::string const& reason) {
    throw Error(fmt::format("cannot read {}", path), reason, "Rebuild it with 'lore-kb build'.");
}

Preamble checked_preamble(std::span<std::byte const> payload, std::string const& path) {
    if (payload.size() < sizeof(Preamble)) refuse(path, "the knowledge base is too short to be one");
    Preamble preamble;
    std::memcpy(&preamble, payload.data(), sizeof preamble);
    if (preamble.layout > layout_version)
        throw Error(
            fmt::format("cannot read {}", path),
            fmt::format("written by a newer Lore: layout {}, this one reads {}", preamble.layout, layout_version),
            "Update Lore.");
    if (preamble.layout == 0) refuse(path, "its layout is unknown");
    if (preamble.binary_channels != binary_count || preamble.continuous_channels != continuous_count)
        refuse(path,
               fmt::format("it has {} binary and {} continuous channels, this Lore has {} and {}",
                           preamble.binary_channels, preamble.continuous_channels, binary_count, continuous_count));
    if (preamble.window_length < 1 || preamble.window_length > std::uint32_t{longest_window})
        refuse(path, fmt::format("a window length of {} steps", preamble.window_length));
    if (!(preamble.match_threshold > 0) || !std::isfinite(preamble.match_threshold))
        refuse(path, fmt::format("a match threshold of {}", preamble.match_threshold));
    // Bounding both numbers by what the file could hold keeps the sums of Layout far from overflow.
    if (preamble.features > most_features || preamble.provenance_length > payload.size() ||
        Layout{preamble.features, preamble.window_length, preamble.provenance_length}.end != payload.size())
        refuse(path, fmt::format("{} features do not fit its length", preamble.features));
    return preamble;
}

/// The first number outside its range, told as a reason; "" if there is none.
std::string why_invalid(KnowledgeBase::Parts const& parts) {
    auto const outside = [](float value) { return !(value >= 0 && value <= 1); };   // NaN is outside too
    auto const not_finite = [](double value) { return !std::isfinite(value); };
    if (std::any_of(parts.windows.begin(), parts.windows.end(), outside)) return "a window's value is not in 0 .. 1";
    if (std::any_of(parts.bits.begin(), parts.bits.end(),
                    [](std::uint16_t word) { return (word & ~window_bits_mask) != 0; }))
        return "a window has unknown channels";
    if (std::any_of(parts.values.begin(), parts.values.end(), not_finite) ||
        std::any_of(parts.reward_sums.begin(), parts.reward_sums.end(), not_finite))
        return "a feature's value is not finite";
    if (std::find(parts.counts.begin(), parts.counts.end(), 0u) != parts.counts.end())
        return "a feature that nobody exhibited";
    return "";
}

}   // namespace

std::string provenance_json(Provenance const& provenance) {
    return nlohmann::ordered_json{{"made_by", provenance.made_by},
                                  {"kind", provenance.kind},
                                  {"index", provenance.index},
                                  {"sources", provenance.sources},
                                  {"derivation", provenance.derivation},
                                  {"task", provenance.task},
                                  {"individuals", provenance.individuals},
                                  {"windows", provenance.windows},
                                  {"best_balls", provenance.best_balls}}
        .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void write_knowledge_base(std::string const& path, KnowledgeBase const& base) {
    KnowledgeBase::Parts const& parts = base.parts();
    std::string const provenance = provenance_json(parts.provenance);
    auto const features = static_cast<std::uint64_t>(base.size());
    Layout const layout{features, static_cast<std::uint64_t>(parts.config.window_length), provenance.size()};
    Preamble preamble{};
    preamble.layout = layout_version;
    preamble.window_length = static_cast<std::uint32_t>(parts.config.window_length);
    preamble.match_threshold = parts.config.match_threshold;
    preamble.binary_channels = binary_count;
    preamble.continuous_channels = continuous_count;
    preamble.features = features;
    preamble.provenance_length = provenance.size();

    PayloadPieces payload;
    payload.place(0, std::span<Preamble const>{&preamble, 1});
    payload.place(layout.values, parts.values);
    payload.place(layout.reward_sums, parts.reward_sums);
    payload.place(layout.counts, parts.counts);
    payload.place(layout.windows, parts.windows);
    payload.place(layout.bits, parts.bits);
    payload.place(layout.provenance, std::span<char const>{provenance});
    write_plain_container(path, FileKind::knowledge_base, payload.pieces());
}

KnowledgeBase read_knowledge_base(std::string const& path) {
    MappedPayload const mapped = map_container(path, FileKind::knowledge_base);
    Preamble const preamble = checked_preamble(mapped.bytes, path);
    Layout const layout{preamble.features, preamble.window_length, preamble.provenance_length};
    std::uint64_t const steps = preamble.features * preamble.window_length;
    KnowledgeBase::Parts parts{{static_cast<int>(preamble.window_length), preamble.match_threshold},
                               {},
                               view<std::uint16_t>(mapped.bytes, layout.bits, steps),
                               view<float>(mapped.bytes, layout.windows, steps * continuous_count),
                               view<double>(mapped.bytes, layout.values, preamble.features),
                               view<double>(mapped.bytes, layout.reward_sums, preamble.features),
                               view<std::uint32_t>(mapped.bytes, layout.counts, preamble.features),
                               mapped.keep_alive};
    if (std::string const reason = why_invalid(parts); !reason.empty()) refuse(path, reason);
    try {
        auto const text = view<char>(mapped.bytes, layout.provenance, preamble.provenance_length);
        parts.provenance = provenance_of({text.data(), text.size()});
    } catch (std::exception const&) { refuse(path, "its provenance cannot be understood"); }
    return KnowledgeBase{std::move(parts)};
}

}   // namespace lore
