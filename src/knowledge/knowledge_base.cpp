#include <lore/knowledge/knowledge_base.h>

#include <cassert>

namespace lore {

namespace {

std::size_t words_of_a_window(KnowledgeConfig const& config) {
    return static_cast<std::size_t>(config.window_length) * static_cast<std::size_t>(config.channels.words());
}

std::size_t floats_of_a_window(KnowledgeConfig const& config) {
    return static_cast<std::size_t>(config.window_length) *
           static_cast<std::size_t>(config.channels.continuous_count());
}

KnowledgeBase::Parts owned(KnowledgeConfig const& config, Provenance provenance, KnowledgeArrays arrays) {
    auto const kept = std::make_shared<KnowledgeArrays const>(std::move(arrays));
    return {config, std::move(provenance), kept->bits, kept->windows, kept->values, kept->reward_sums, kept->counts,
            kept,   view(kept->evidence)};
}

}   // namespace

KnowledgeBase::KnowledgeBase(Parts parts) : parts_(std::move(parts)) {
    [[maybe_unused]] std::size_t const features = parts_.values.size();
    assert(parts_.bits.size() == features * words_of_a_window(parts_.config));
    assert(parts_.windows.size() == features * floats_of_a_window(parts_.config));
    assert(parts_.reward_sums.size() == features && parts_.counts.size() == features);
    [[maybe_unused]] Evidence const& evidence = parts_.evidence;
    assert(!evidence.has_returns() || evidence.showings.size() == features);
    assert(evidence.return_sums.size() == features * evidence.gammas.size());
    assert(!evidence.has_credit || (evidence.news.size() == features && evidence.gain_sums.size() == features));
    assert(!evidence.has_contrast() ||
           (evidence.successes_that_showed.size() == features && evidence.failures_that_showed.size() == features));
}

KnowledgeBase::KnowledgeBase(KnowledgeConfig config, Provenance provenance, KnowledgeArrays arrays)
    : KnowledgeBase(owned(config, std::move(provenance), std::move(arrays))) {}

KnowledgeBase KnowledgeBase::with_values(std::vector<double> values, Provenance provenance) const {
    struct Kept {
        std::vector<double> values;
        std::shared_ptr<void const> others;
    };
    auto const kept = std::make_shared<Kept const>(Kept{std::move(values), parts_.keep_alive});
    Parts parts = parts_;
    parts.provenance = std::move(provenance);
    parts.values = kept->values;
    parts.keep_alive = kept;
    return KnowledgeBase{std::move(parts)};
}

Window KnowledgeBase::window(int feature) const {
    assert(feature >= 0 && feature < size());
    auto const number = static_cast<std::size_t>(feature);
    std::size_t const words = words_of_a_window(parts_.config), floats = floats_of_a_window(parts_.config);
    return {parts_.bits.subspan(number * words, words), parts_.windows.subspan(number * floats, floats)};
}

}   // namespace lore
