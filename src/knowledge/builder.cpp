#include <lore/knowledge/builder.h>

#include <cassert>

namespace lore {

KnowledgeBuilder::KnowledgeBuilder(KnowledgeConfig config, std::unique_ptr<FeatureIndex> index)
    : config_(config), index_(std::move(index)), search_(index_->search()) {
    assert(index_->size() == 0);
}

void KnowledgeBuilder::add_individual(std::span<Window const> windows, double balls) {
    ++individuals_;   // numbers individuals from 1, so that 0 in last_exhibitor_ is nobody
    windows_ += windows.size();
    for (Window const& window : windows) {
        int feature = search_->match(window).feature;
        if (feature >= 0) {
            ++matched_;
        } else {
            feature = features();
            index_->add(window);
            // Only the channels of a window count; what else its words hold stays out of files and comparisons.
            for (std::uint16_t const word : window.bits) bits_.push_back(word & window_bits_mask);
            values_.insert(values_.end(), window.values.begin(), window.values.end());
            sums_.push_back(0);
            counts_.push_back(0);
            last_exhibitor_.push_back(0);
        }
        auto const i = static_cast<std::size_t>(feature);
        if (last_exhibitor_[i] == individuals_) continue;
        last_exhibitor_[i] = individuals_;
        sums_[i] += balls;
        ++counts_[i];
    }
}

KnowledgeBase KnowledgeBuilder::finish(Provenance provenance) && {
    provenance.individuals = individuals_;
    provenance.windows = windows_;
    std::vector<double> means(sums_.size());
    for (std::size_t i = 0; i < means.size(); ++i) means[i] = sums_[i] / counts_[i];
    search_.reset();
    index_.reset();
    return KnowledgeBase{config_, std::move(provenance),
                         {std::move(bits_), std::move(values_), std::move(means), std::move(sums_), std::move(counts_)}};
}

} // namespace lore
