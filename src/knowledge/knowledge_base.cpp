#include <lore/knowledge/knowledge_base.h>

#include <cassert>

namespace lore {

namespace {

KnowledgeBase::Parts owned(KnowledgeConfig const& config, Provenance provenance, KnowledgeArrays arrays) {
    auto const kept = std::make_shared<KnowledgeArrays const>(std::move(arrays));
    return {config, std::move(provenance), kept->bits, kept->windows, kept->values, kept->reward_sums, kept->counts,
            kept,   view(kept->evidence)};
}

}   // namespace

KnowledgeBase::KnowledgeBase(Parts parts) : parts_(std::move(parts)) {
    [[maybe_unused]] std::size_t const features = parts_.values.size();
    [[maybe_unused]] auto const length = static_cast<std::size_t>(parts_.config.window_length);
    assert(parts_.bits.size() == features * length);
    assert(parts_.windows.size() == features * length * continuous_count);
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
    auto const length = static_cast<std::size_t>(parts_.config.window_length);
    std::size_t const first = static_cast<std::size_t>(feature) * length;
    return {parts_.bits.subspan(first, length),
            parts_.windows.subspan(first * continuous_count, length * continuous_count)};
}

}   // namespace lore
