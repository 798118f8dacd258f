#include "evidence_gatherer.h"

#include <lore/knowledge/value.h>

#include <cassert>

namespace lore {

KnowledgeBuilder::KnowledgeBuilder(KnowledgeConfig config, std::unique_ptr<GrowingIndex> index, EvidenceConfig evidence)
    : config_(config), index_(std::move(index)) {
    assert(index_->size() == 0);
    bool const wanted = !evidence.gammas.empty() || evidence.credit || evidence.success_reward;
    if (wanted) evidence_ = std::make_unique<EvidenceGatherer>(std::move(evidence), config.window_length);
}

KnowledgeBuilder::~KnowledgeBuilder() = default;
KnowledgeBuilder::KnowledgeBuilder(KnowledgeBuilder&&) noexcept = default;

void KnowledgeBuilder::add_individual(Exhibit const& exhibit) {
    Crew alone{1};
    add_individuals({&exhibit, 1}, alone);
}

void KnowledgeBuilder::add_individuals(std::span<Exhibit const> exhibits, Crew& crew) {
    std::vector<Window> windows;
    for (Exhibit const& exhibit : exhibits)
        windows.insert(windows.end(), exhibit.windows.begin(), exhibit.windows.end());
    std::vector<int> const shown = index_->take_up(windows, crew);
    std::size_t next = 0;
    for (Exhibit const& exhibit : exhibits) {
        ++individuals_;   // numbers individuals from 1, so that 0 in last_exhibitor_ is no individual
        windows_ += exhibit.windows.size();
        if (evidence_) evidence_->begin(exhibit);
        for (std::size_t i = 0; i < exhibit.windows.size(); ++i) {
            int const feature = shown[next++];
            if (feature < features()) ++matched_;
            else add_feature();
            show(feature, i, exhibit.reward);
        }
        if (evidence_) evidence_->end();
    }
}

void KnowledgeBuilder::add_feature() {
    sums_.push_back(0);
    counts_.push_back(0);
    last_exhibitor_.push_back(0);
    if (evidence_) evidence_->add_feature();
}

void KnowledgeBuilder::show(int feature, std::size_t window, double reward) {
    auto const i = static_cast<std::size_t>(feature);
    bool const first = last_exhibitor_[i] != individuals_;
    if (evidence_) evidence_->show(feature, window, first);
    if (!first) return;
    last_exhibitor_[i] = individuals_;
    sums_[i] += reward;
    ++counts_[i];
}

KnowledgeBase KnowledgeBuilder::finish(Provenance provenance) && {
    provenance.individuals = individuals_;
    provenance.windows = windows_;
    if (evidence_) provenance.value = text(ValueConfig{});
    std::vector<double> means(sums_.size());
    for (std::size_t i = 0; i < means.size(); ++i) means[i] = mean_value(sums_[i], counts_[i]);
    struct Kept {
        WindowArrays windows;
        std::vector<double> values, reward_sums;
        std::vector<std::uint32_t> counts;
        EvidenceArrays evidence;
    };
    WindowArrays windows = index_->release();
    index_.reset();   // its memory is gone before more is taken
    auto const kept =
        std::make_shared<Kept const>(Kept{std::move(windows), std::move(means), std::move(sums_), std::move(counts_),
                                          evidence_ ? std::move(*evidence_).finish() : EvidenceArrays{}});
    return KnowledgeBase{{config_, std::move(provenance), kept->windows.bits, kept->windows.values, kept->values,
                          kept->reward_sums, kept->counts, kept, view(kept->evidence)}};
}

}   // namespace lore
