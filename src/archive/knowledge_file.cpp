#include <lore/archive/knowledge_file.h>

#include "version_1.h"
#include "world_json.h"

#include <lore/archive/container.h>
#include <lore/archive/knowledge_export.h>
#include <lore/core/error.h>
#include <lore/core/whole_number.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>

#include <fmt/format.h>

namespace lore {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t layout_version = 3;   ///< 1: without further evidence; 2: of the world of version 1
constexpr std::uint64_t alignment = 64;
constexpr std::uint64_t most_features = 1u << 30;   ///< a feature's number is an int

/// Preamble::evidence: which parts there are.
enum EvidenceFlag : std::uint64_t { returns_flag = 1, credit_flag = 2, contrast_flag = 4 };

/// The first bytes of the payload. The arrays follow in the order of Layout, the provenance as JSON at the end.
struct Preamble {
    std::uint32_t layout;
    std::uint32_t window_length;
    float match_threshold;
    std::uint32_t binary_channels;
    std::uint32_t continuous_channels;
    std::uint32_t gammas;   ///< how many; this and `evidence` are 0 in layout 1
    std::uint64_t features;
    std::uint64_t provenance_length;
    std::uint64_t evidence;
    std::uint64_t padding[2];
};

/// How many successes and failures a contrast compares.
struct ContrastTotals {
    std::uint64_t successes, failures;
    double success_reward;   ///< in layout 2 a number of 32 bits and padding
};
static_assert(sizeof(Preamble) == alignment && sizeof(ContrastTotals) == 24 && container_header_size % alignment == 0);

/// 16-bit words a step, as Channels::words().
std::uint64_t words(Preamble const& preamble) {
    return (std::uint64_t{preamble.binary_channels} + preamble.continuous_channels + 15) / 16;
}

/// Where each array starts in the payload [bytes].
struct Layout {
    std::uint64_t values, reward_sums, counts, windows, bits;
    // Each of these only if its part of the evidence is there.
    std::uint64_t gammas, showings, return_sums, news, gain_sums, contrast, successes, failures;
    std::uint64_t provenance, end;

    explicit Layout(Preamble const& preamble) {
        std::uint64_t const features = preamble.features, steps = preamble.window_length;
        std::uint64_t at = sizeof(Preamble);
        auto const take = [&at](std::uint64_t bytes) {
            std::uint64_t const start = at;
            at = (at + bytes + alignment - 1) / alignment * alignment;
            return start;
        };
        values = take(features * sizeof(double));
        reward_sums = take(features * sizeof(double));
        counts = take(features * sizeof(std::uint32_t));
        windows = take(features * steps * preamble.continuous_channels * sizeof(float));
        bits = take(features * steps * words(preamble) * sizeof(std::uint16_t));
        auto const take_if = [&](EvidenceFlag flag, std::uint64_t bytes) {
            return (preamble.evidence & flag) != 0 ? take(bytes) : at;
        };
        gammas = take_if(returns_flag, preamble.gammas * sizeof(double));
        showings = take_if(returns_flag, features * sizeof(std::uint64_t));
        return_sums = take_if(returns_flag, preamble.gammas * features * sizeof(double));
        news = take_if(credit_flag, features * sizeof(std::uint32_t));
        gain_sums = take_if(credit_flag, features * sizeof(double));
        contrast = take_if(contrast_flag, sizeof(ContrastTotals));
        successes = take_if(contrast_flag, features * sizeof(std::uint32_t));
        failures = take_if(contrast_flag, features * sizeof(std::uint32_t));
        provenance = at;
        end = at + preamble.provenance_length;
    }
};

/// The key of Provenance::best_reward: it names the unit.
std::string best_key(Provenance const& provenance) { return "best_" + provenance.reward_unit; }

double real_number(Json const& json) {
    double const number = json.get<double>();
    if (!std::isfinite(number)) throw std::out_of_range("a number is not finite");
    return number;
}
/// Whole numbers without a decimal point.
Json number_json(double number) {
    bool const whole = std::trunc(number) == number && std::abs(number) < 0x1p53;
    return whole ? Json(static_cast<std::int64_t>(number)) : Json(number);
}

Provenance provenance_of(Json const& json, WorldRecord const& world) {
    Provenance provenance;
    provenance.reward_unit = world.reward_unit;
    json.at("made_by").get_to(provenance.made_by);
    json.at("kind").get_to(provenance.kind);
    json.at("index").get_to(provenance.index);
    json.at("sources").get_to(provenance.sources);
    json.at("derivation").get_to(provenance.derivation);
    json.at("task").get_to(provenance.task);
    if (json.contains("value")) json.at("value").get_to(provenance.value);
    provenance.individuals = whole_number<std::uint64_t>(json.at("individuals"));
    provenance.windows = whole_number<std::uint64_t>(json.at("windows"));
    provenance.best_reward = real_number(json.at(best_key(provenance)));
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
    if (preamble.layout == 1) preamble.gammas = 0, preamble.evidence = 0;
    if ((preamble.evidence & ~std::uint64_t{returns_flag | credit_flag | contrast_flag}) != 0 ||
        preamble.gammas > most_gammas || (preamble.gammas > 0) != ((preamble.evidence & returns_flag) != 0))
        refuse(path, "its evidence is of no known kind");
    std::uint64_t const channels = std::uint64_t{preamble.binary_channels} + preamble.continuous_channels;
    if (channels < 2 || channels > most_channels)
        refuse(path, fmt::format("it has {} binary and {} continuous channels", preamble.binary_channels,
                                 preamble.continuous_channels));
    if (preamble.window_length < 1 || preamble.window_length > std::uint32_t{longest_window})
        refuse(path, fmt::format("a window length of {} steps", preamble.window_length));
    if (!(preamble.match_threshold > 0) || !std::isfinite(preamble.match_threshold))
        refuse(path, fmt::format("a match threshold of {}", preamble.match_threshold));
    // Bounding both numbers by what the file could hold keeps the sums of Layout far from overflow.
    if (preamble.features > most_features || preamble.provenance_length > payload.size() ||
        Layout{preamble}.end != payload.size())
        refuse(path, fmt::format("{} features do not fit its length", preamble.features));
    return preamble;
}

std::string why_invalid(Evidence const& evidence) {
    auto const not_finite = [](double value) { return !std::isfinite(value); };
    auto const no_discount = [](double gamma) { return !(gamma > 0 && gamma < 1); };
    std::vector<double> const& gammas = evidence.gammas;
    if (std::any_of(gammas.begin(), gammas.end(), no_discount) ||
        std::adjacent_find(gammas.begin(), gammas.end(), std::greater_equal<>{}) != gammas.end())
        return "its gammas are no increasing discounts";
    if (std::find(evidence.showings.begin(), evidence.showings.end(), 0u) != evidence.showings.end())
        return "a feature that nobody showed";
    if (std::any_of(evidence.return_sums.begin(), evidence.return_sums.end(), not_finite) ||
        std::any_of(evidence.gain_sums.begin(), evidence.gain_sums.end(), not_finite))
        return "a feature's evidence is not finite";
    auto const more_than = [](std::uint64_t all) { return [all](std::uint32_t count) { return count > all; }; };
    if (std::any_of(evidence.successes_that_showed.begin(), evidence.successes_that_showed.end(),
                    more_than(evidence.successes)) ||
        std::any_of(evidence.failures_that_showed.begin(), evidence.failures_that_showed.end(),
                    more_than(evidence.failures)))
        return "a feature that more have shown than there were";
    return "";
}

/// The first number outside its range, told as a reason; "" if there is none.
std::string why_invalid(KnowledgeBase::Parts const& parts) {
    Channels const& channels = parts.config.channels;
    auto const in_a_step = static_cast<std::size_t>(channels.words());
    std::vector<std::uint16_t> known;
    for (int word = 0; word < channels.words(); ++word) known.push_back(binary_mask(channels, word));
    auto const outside = [](float value) { return !(value >= 0 && value <= 1); };   // NaN is outside too
    auto const not_finite = [](double value) { return !std::isfinite(value); };
    if (std::any_of(parts.windows.begin(), parts.windows.end(), outside)) return "a window's value is not in 0 .. 1";
    for (std::size_t i = 0; i < parts.bits.size(); ++i)
        if ((parts.bits[i] & ~known[i % in_a_step]) != 0) return "a window has unknown channels";
    if (std::any_of(parts.values.begin(), parts.values.end(), not_finite) ||
        std::any_of(parts.reward_sums.begin(), parts.reward_sums.end(), not_finite))
        return "a feature's value is not finite";
    if (std::find(parts.counts.begin(), parts.counts.end(), 0u) != parts.counts.end())
        return "a feature that nobody exhibited";
    return why_invalid(parts.evidence);
}

Preamble preamble_of(KnowledgeBase::Parts const& parts, std::size_t provenance_length) {
    Evidence const& evidence = parts.evidence;
    Preamble preamble{};
    preamble.layout = layout_version;
    preamble.window_length = static_cast<std::uint32_t>(parts.config.window_length);
    preamble.match_threshold = parts.config.match_threshold;
    preamble.binary_channels = static_cast<std::uint32_t>(parts.config.channels.binary_count());
    preamble.continuous_channels = static_cast<std::uint32_t>(parts.config.channels.continuous_count());
    preamble.gammas = static_cast<std::uint32_t>(evidence.gammas.size());
    preamble.features = parts.values.size();
    preamble.provenance_length = provenance_length;
    if (evidence.has_returns()) preamble.evidence |= returns_flag;
    if (evidence.has_credit) preamble.evidence |= credit_flag;
    if (evidence.has_contrast()) preamble.evidence |= contrast_flag;
    return preamble;
}

Evidence evidence_in(std::span<std::byte const> payload, Preamble const& preamble, Layout const& layout,
                     std::string const& path) {
    std::uint64_t const features = preamble.features;
    Evidence evidence;
    if ((preamble.evidence & returns_flag) != 0) {
        auto const gammas = view<double>(payload, layout.gammas, preamble.gammas);
        evidence.gammas.assign(gammas.begin(), gammas.end());
        evidence.showings = view<std::uint64_t>(payload, layout.showings, features);
        evidence.return_sums = view<double>(payload, layout.return_sums, preamble.gammas * features);
    }
    if ((preamble.evidence & credit_flag) != 0) {
        evidence.has_credit = true;
        evidence.news = view<std::uint32_t>(payload, layout.news, features);
        evidence.gain_sums = view<double>(payload, layout.gain_sums, features);
    }
    if ((preamble.evidence & contrast_flag) != 0) {
        ContrastTotals const totals = view<ContrastTotals>(payload, layout.contrast, 1)[0];
        if (preamble.layout == 2)
            evidence.success_reward = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(totals.success_reward));
        else evidence.success_reward = totals.success_reward;
        if (!std::isfinite(*evidence.success_reward)) refuse(path, "the reward of its successes is not finite");
        evidence.successes = totals.successes;
        evidence.failures = totals.failures;
        evidence.successes_that_showed = view<std::uint32_t>(payload, layout.successes, features);
        evidence.failures_that_showed = view<std::uint32_t>(payload, layout.failures, features);
    }
    return evidence;
}

Json json_of(Provenance const& provenance) {
    Json json{{"made_by", provenance.made_by},
              {"kind", provenance.kind},
              {"index", provenance.index},
              {"sources", provenance.sources},
              {"derivation", provenance.derivation},
              {"task", provenance.task},
              {"individuals", provenance.individuals},
              {"windows", provenance.windows},
              {best_key(provenance), number_json(provenance.best_reward)}};
    if (!provenance.value.empty()) json["value"] = provenance.value;
    return json;
}

std::string text(Json const& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }

}   // namespace

std::string provenance_json(Provenance const& provenance) { return text(json_of(provenance)); }

std::string provenance_json(KnowledgeBase const& base) {
    Json json = json_of(base.provenance());
    json["world"] = json_of(world_record(base));
    return text(json);
}

WorldRecord world_record(KnowledgeBase const& base) {
    WorldRecord record;
    record.reward_unit = base.provenance().reward_unit;
    record.channels = base.config().channels;
    return record;
}

void write_knowledge_base(std::string const& path, KnowledgeBase const& base) {
    KnowledgeBase::Parts const& parts = base.parts();
    std::string const provenance = provenance_json(base);
    Evidence const& evidence = parts.evidence;
    Preamble const preamble = preamble_of(parts, provenance.size());
    Layout const layout{preamble};
    ContrastTotals const totals{evidence.successes, evidence.failures, evidence.success_reward.value_or(0)};

    PayloadPieces payload;
    payload.place(0, std::span<Preamble const>{&preamble, 1});
    payload.place(layout.values, parts.values);
    payload.place(layout.reward_sums, parts.reward_sums);
    payload.place(layout.counts, parts.counts);
    payload.place(layout.windows, parts.windows);
    payload.place(layout.bits, parts.bits);
    if (evidence.has_returns()) {
        payload.place(layout.gammas, std::span<double const>{evidence.gammas});
        payload.place(layout.showings, evidence.showings);
        payload.place(layout.return_sums, evidence.return_sums);
    }
    if (evidence.has_credit) {
        payload.place(layout.news, evidence.news);
        payload.place(layout.gain_sums, evidence.gain_sums);
    }
    if (evidence.has_contrast()) {
        payload.place(layout.contrast, std::span<ContrastTotals const>{&totals, 1});
        payload.place(layout.successes, evidence.successes_that_showed);
        payload.place(layout.failures, evidence.failures_that_showed);
    }
    payload.place(layout.provenance, std::span<char const>{provenance});
    write_plain_container(path, FileKind::knowledge_base, payload.pieces());
}

namespace {

/// What the provenance says of the base and its world; layouts before 3 leave the world out.
std::pair<Provenance, WorldRecord> origin_in(std::span<std::byte const> payload, Preamble const& preamble,
                                             Layout const& layout, std::string const& path) {
    auto const text = view<char>(payload, layout.provenance, preamble.provenance_length);
    std::string reason = "its provenance cannot be understood";
    try {
        Json const json = Json::parse(text.begin(), text.end());
        WorldRecord world = preamble.layout < 3 ? world_of_version_1() : world_record_of(json.at("world"));
        return {provenance_of(json, world), std::move(world)};
    } catch (Json::exception const&) {
    } catch (std::out_of_range const& error) { reason = fmt::format("{}: {}", reason, error.what()); }
    refuse(path, reason);
}

}   // namespace

KnowledgeBase read_knowledge_base(std::string const& path) {
    MappedPayload const mapped = map_container(path, FileKind::knowledge_base);
    Preamble const preamble = checked_preamble(mapped.bytes, path);
    Layout const layout{preamble};
    auto [provenance, world] = origin_in(mapped.bytes, preamble, layout, path);
    auto const count = [](int channels) { return static_cast<std::uint32_t>(channels); };
    if (preamble.binary_channels != count(world.channels.binary_count()) ||
        preamble.continuous_channels != count(world.channels.continuous_count()))
        refuse(path, fmt::format("it has {} binary and {} continuous channels, its world {} and {}",
                                 preamble.binary_channels, preamble.continuous_channels, world.channels.binary_count(),
                                 world.channels.continuous_count()));
    std::uint64_t const steps = preamble.features * preamble.window_length;
    KnowledgeBase::Parts parts{
        {static_cast<int>(preamble.window_length), preamble.match_threshold, std::move(world.channels)},
        std::move(provenance),
        view<std::uint16_t>(mapped.bytes, layout.bits, steps * words(preamble)),
        view<float>(mapped.bytes, layout.windows, steps * preamble.continuous_channels),
        view<double>(mapped.bytes, layout.values, preamble.features),
        view<double>(mapped.bytes, layout.reward_sums, preamble.features),
        view<std::uint32_t>(mapped.bytes, layout.counts, preamble.features),
        mapped.keep_alive,
        evidence_in(mapped.bytes, preamble, layout, path)};
    if (std::string const reason = why_invalid(parts); !reason.empty()) refuse(path, reason);
    return KnowledgeBase{std::move(parts)};
}

std::vector<KnowledgeBase> read_knowledge_bases(std::vector<std::string> const& paths) {
    std::vector<KnowledgeBase> bases;
    for (std::string const& path : paths) {
        bases.push_back(read_knowledge_base(path));
        int const length = bases.back().config().window_length, first = bases.front().config().window_length;
        if (length != first)
            throw UsageError(fmt::format("cannot combine {} with {}", path, paths.front()),
                             fmt::format("windows of {} and of {} steps", length, first),
                             "Give knowledge bases of one window length.");
    }
    return bases;
}

void require_channels(KnowledgeBase const& base, std::string const& path, Channels const& channels) {
    if (std::string const why = why_misfit(base.config().channels, channels); !why.empty())
        throw UsageError(fmt::format("cannot use {}", path), why, "Give a base of a world with these channels.");
}

}   // namespace lore
