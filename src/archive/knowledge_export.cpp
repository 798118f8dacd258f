#include <lore/archive/knowledge_export.h>

#include <lore/archive/atomic_file.h>
#include <lore/archive/npy_file.h>
#include <lore/core/directory.h>
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
    Channels const& channels = base.config().channels;
    std::string csv = "feature,value,reward_sum,count";
    auto const steps = static_cast<std::size_t>(base.config().window_length);
    for (std::size_t step = 0; step < steps; ++step)
        for (ChannelInfo const& channel : channels.all())
            fmt::format_to(std::back_inserter(csv), ",{}_{}", channel.name, step);
    append_evidence_names(csv, base.evidence());
    csv += '\n';
    for (int feature = 0; feature < base.size(); ++feature) {
        fmt::format_to(std::back_inserter(csv), "{},{},{},{}", feature, base.value(feature), base.reward_sum(feature),
                       base.count(feature));
        Window const window = base.window(feature);
        for (std::size_t step = 0; step < steps; ++step)
            for (float const value : channels_at(channels, window, step))
                fmt::format_to(std::back_inserter(csv), ",{}", value);
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
    Channels const& channels = base.config().channels;
    auto const channel_count = static_cast<std::size_t>(channels.count());
    std::vector<float> windows;
    windows.reserve(features * steps * channel_count);
    for (int feature = 0; feature < base.size(); ++feature)
        for (std::size_t step = 0; step < steps; ++step)
            for (float const value : channels_at(channels, base.window(feature), step)) windows.push_back(value);
    std::array const shape{features, steps, channel_count};
    std::array const one{features};
    write_npy(file("features.npy"), windows, shape);
    write_npy(file("values.npy"), base.values(), one);
    write_npy(file("reward_sums.npy"), base.parts().reward_sums, one);
    write_npy(file("counts.npy"), base.parts().counts, one);
    // Evidence that this base lacks may be there of another.
    for (char const* const part : {"gammas.npy", "showings.npy", "return_sums.npy", "news.npy", "gain_sums.npy",
                                   "contrast_totals.npy", "successes_that_showed.npy", "failures_that_showed.npy"})
        remove_file(file(part));
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
        std::array const totals{static_cast<double>(evidence.successes), static_cast<double>(evidence.failures)};
        write_npy(file("contrast_totals.npy"), std::span<double const>{totals}, std::array{totals.size()});
        write_npy(file("successes_that_showed.npy"), evidence.successes_that_showed, one);
        write_npy(file("failures_that_showed.npy"), evidence.failures_that_showed, one);
    }
    write_file_atomically(file("provenance.json"), provenance_json(base) + "\n");
}

namespace {

/// `values` are those of all channels at one step; where they stand is told as a reason.
void append_step(Trace& trace, std::span<float const> values, std::string const& path, std::string const& place) {
    Channels const& channels = trace.channels;
    for (int const channel : channels.binary()) {
        float const value = values[static_cast<std::size_t>(channel)];
        if (value != 0 && value != 1)
            throw Error(fmt::format("cannot read windows from {}", path),
                        fmt::format("{}: {} is {}, not 0 or 1", place, channels[channel].name, value), "Correct it.");
    }
    auto const words = static_cast<std::size_t>(channels.words());
    trace.channel_bits.resize(trace.channel_bits.size() + words);
    auto const step = std::span{trace.channel_bits}.last(words);
    put_channel_bits(channels, values, step);
    for (std::size_t word = 0; word < words; ++word) step[word] &= binary_mask(channels, static_cast<int>(word));
    for (int const channel : channels.continuous()) trace.values.push_back(values[static_cast<std::size_t>(channel)]);
    trace.positions.emplace_back();
}

}   // namespace

Trace read_windows(std::string const& path, KnowledgeConfig const& config) {
    NpyArray const array = read_npy(path);
    auto const steps = static_cast<std::size_t>(config.window_length);
    auto const channel_count = static_cast<std::size_t>(config.channels.count());
    bool const by_step = array.shape.size() == 3 && array.shape[1] == steps && array.shape[2] == channel_count;
    bool const in_a_row = array.shape.size() == 2 && array.shape[1] == steps * channel_count;
    if (!by_step && !in_a_row)
        throw Error(fmt::format("cannot read windows from {}", path),
                    fmt::format("its shape is ({0}), not (n, {1}, {2}) or (n, {3})", fmt::join(array.shape, ", "),
                                steps, channel_count, steps * channel_count),
                    "Reshape it to the knowledge base's window length.");
    Trace trace;
    trace.channels = config.channels;
    for (std::size_t row = 0; row < array.values.size() / channel_count; ++row)
        append_step(trace, std::span{array.values}.subspan(row * channel_count, channel_count), path,
                    fmt::format("window {}, step {}", row / steps, row % steps));
    return trace;
}

}   // namespace lore
