#include <lore/archive/knowledge_export.h>

#include <lore/archive/atomic_file.h>
#include <lore/archive/npy_file.h>
#include <lore/core/error.h>
#include <lore/core/file.h>

#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

void append_evidence_names(std::string& csv, Evidence const& evidence) {
    if (evidence.has_returns()) csv += ",showings";
    for (double const gamma : evidence.gammas) fmt::format_to(std::back_inserter(csv), ",return_sum_{}", gamma);
    if (evidence.has_credit) csv += ",news,gain_sum";
    if (evidence.has_contrast()) csv += ",successes_that_showed,failures_that_showed";
}

void append_evidence(std::string& csv, Evidence const& evidence, std::size_t feature, std::size_t features) {
    auto const append = [&](auto number) { fmt::format_to(std::back_inserter(csv), ",{}", number); };
    if (evidence.has_returns()) append(evidence.showings[feature]);
    for (std::size_t gamma = 0; gamma < evidence.gammas.size(); ++gamma)
        append(evidence.return_sums[gamma * features + feature]);
    if (evidence.has_credit) {
        append(evidence.news[feature]);
        append(evidence.gain_sums[feature]);
    }
    if (evidence.has_contrast()) {
        append(evidence.successes_that_showed[feature]);
        append(evidence.failures_that_showed[feature]);
    }
}

}   // namespace

std::string knowledge_csv(KnowledgeBase const& base) {
    std::string csv = "feature,value,reward_sum,count";
    auto const steps = static_cast<std::size_t>(base.config().window_length);
    for (std::size_t step = 0; step < steps; ++step)
        for (std::string_view const channel : channel_names)
            fmt::format_to(std::back_inserter(csv), ",{}_{}", channel, step);
    append_evidence_names(csv, base.evidence());
    csv += '\n';
    for (int feature = 0; feature < base.size(); ++feature) {
        fmt::format_to(std::back_inserter(csv), "{},{},{},{}", feature, base.value(feature), base.reward_sum(feature),
                       base.count(feature));
        Window const window = base.window(feature);
        for (std::size_t step = 0; step < steps; ++step)
            for (float const value : channels_at(window, step)) fmt::format_to(std::back_inserter(csv), ",{}", value);
        append_evidence(csv, base.evidence(), static_cast<std::size_t>(feature), static_cast<std::size_t>(base.size()));
        csv += '\n';
    }
    return csv;
}

void export_knowledge(std::string const& directory, KnowledgeBase const& base) {
    make_directory(directory);
    auto const file = [&](char const* name) { return (std::filesystem::path{directory} / name).string(); };

    auto const features = static_cast<std::size_t>(base.size());
    auto const steps = static_cast<std::size_t>(base.config().window_length);
    std::vector<float> channels;
    channels.reserve(features * steps * channel_count);
    for (int feature = 0; feature < base.size(); ++feature)
        for (std::size_t step = 0; step < steps; ++step)
            for (float const value : channels_at(base.window(feature), step)) channels.push_back(value);
    std::array const shape{features, steps, static_cast<std::size_t>(channel_count)};
    std::array const one{features};
    write_npy(file("features.npy"), channels, shape);
    write_npy(file("values.npy"), base.values(), one);
    write_npy(file("reward_sums.npy"), base.parts().reward_sums, one);
    write_npy(file("counts.npy"), base.parts().counts, one);
    Evidence const& evidence = base.evidence();
    if (evidence.has_returns()) {
        std::vector<double> const showings(evidence.showings.begin(), evidence.showings.end());
        write_npy(file("gammas.npy"), std::span<double const>{evidence.gammas}, std::array{evidence.gammas.size()});
        write_npy(file("showings.npy"), std::span<double const>{showings}, one);
        write_npy(file("return_sums.npy"), evidence.return_sums, std::array{evidence.gammas.size(), features});
    }
    if (evidence.has_credit) {
        write_npy(file("news.npy"), evidence.news, one);
        write_npy(file("gain_sums.npy"), evidence.gain_sums, one);
    }
    if (evidence.has_contrast()) {
        write_npy(file("successes_that_showed.npy"), evidence.successes_that_showed, one);
        write_npy(file("failures_that_showed.npy"), evidence.failures_that_showed, one);
    }
    write_file_atomically(file("provenance.json"), provenance_json(base.provenance()) + "\n");
}

Trace read_windows(std::string const& path, int window_length) {
    NpyArray const array = read_npy(path);
    auto const steps = static_cast<std::size_t>(window_length);
    bool const by_step = array.shape.size() == 3 && array.shape[1] == steps && array.shape[2] == channel_count;
    bool const in_a_row = array.shape.size() == 2 && array.shape[1] == steps * channel_count;
    if (!by_step && !in_a_row)
        throw Error(fmt::format("cannot read windows from {}", path),
                    fmt::format("its shape is ({0}), not (n, {1}, {2}) or (n, {3})", fmt::join(array.shape, ", "),
                                steps, channel_count, steps * channel_count),
                    "Reshape it to the knowledge base's window length.");
    Trace trace;
    std::size_t const rows = array.values.size() / channel_count;
    for (std::size_t row = 0; row < rows; ++row) {
        float const* const channels = array.values.data() + row * channel_count;
        std::uint16_t word = 0;
        for (std::size_t i = 0; i < binary_channels.size(); ++i) {
            float const value = channels[binary_channels[i]];
            if (value != 0 && value != 1)
                throw Error(fmt::format("cannot read windows from {}", path),
                            fmt::format("window {}, step {}: {} is {}, not 0 or 1", row / steps, row % steps,
                                        channel_names[static_cast<std::size_t>(binary_channels[i])], value),
                            "Correct it.");
            if (value == 1) word |= static_cast<std::uint16_t>(1u << i);
        }
        trace.channel_bits.push_back(word);
        for (int const channel : continuous_channels) trace.values.push_back(channels[channel]);
    }
    return trace;
}

}   // namespace lore
