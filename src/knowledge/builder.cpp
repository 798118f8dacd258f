#include <lore/knowledge/builder.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <future>

namespace lore {

KnowledgeBuilder::KnowledgeBuilder(KnowledgeConfig config, std::unique_ptr<FeatureIndex> index)
    : config_(config), index_(std::move(index)) {
    assert(index_->size() == 0);
    searches_.push_back(index_->search());
}

void KnowledgeBuilder::add_individual(std::span<Window const> windows, double balls) {
    ++individuals_;   // numbers individuals from 1, so that 0 in last_exhibitor_ is nobody
    windows_ += windows.size();
    for (Window const& window : windows) {
        int feature = searches_.front()->match(window).feature;
        if (feature >= 0) {
            ++matched_;
        } else {
            index_->add(window);
            feature = add_feature();
        }
        reward(feature, balls);
    }
}

/// The long part, finding each window's nearest feature among those known before, changes nothing and can be shared.
/// What the individuals themselves add goes to a small index first, which every later window is held against, in order.
void KnowledgeBuilder::add_individuals(std::span<Exhibit const> exhibits, int threads) {
    std::vector<Window const*> windows;
    for (Exhibit const& exhibit : exhibits)
        for (Window const& window : exhibit.windows) windows.push_back(&window);
    std::vector<Match> const known = match_all(windows, threads);

    int const before = features();
    auto const fresh = make_exact_index(config_);
    auto const fresh_search = fresh->search();
    std::vector<Window const*> added;
    std::size_t next = 0;
    for (Exhibit const& exhibit : exhibits) {
        ++individuals_;
        windows_ += exhibit.windows.size();
        for (Window const& window : exhibit.windows) {
            Match match = known[next++];
            if (Match const among_fresh = fresh_search->match(window);
                among_fresh.squared_distance < match.squared_distance)
                match = {before + among_fresh.feature, among_fresh.squared_distance};
            if (match.found()) {
                ++matched_;
            } else {
                fresh->add(window);
                added.push_back(&window);
                match.feature = add_feature();
            }
            reward(match.feature, exhibit.balls);
        }
    }
    for (Window const* window : added) index_->add(*window);
}

std::vector<Match> KnowledgeBuilder::match_all(std::span<Window const* const> windows, int threads) {
    constexpr std::size_t share = 512;   // windows that a thread takes at once
    std::vector<Match> matches(windows.size());
    std::atomic<std::size_t> taken{0};
    auto const work = [&](FeatureSearch& search) {
        for (std::size_t first; (first = taken.fetch_add(share)) < windows.size();)
            for (std::size_t i = first; i < std::min(first + share, windows.size()); ++i)
                matches[i] = search.match(*windows[i]);
    };
    while (searches_.size() < static_cast<std::size_t>(threads)) searches_.push_back(index_->search());
    std::vector<std::future<void>> helpers;
    for (int thread = 1; thread < threads; ++thread)
        helpers.push_back(std::async(std::launch::async, work, std::ref(*searches_[static_cast<std::size_t>(thread)])));
    work(*searches_.front());
    for (std::future<void>& helper : helpers) helper.get();
    return matches;
}

int KnowledgeBuilder::add_feature() {
    sums_.push_back(0);
    counts_.push_back(0);
    last_exhibitor_.push_back(0);
    return features() - 1;
}

void KnowledgeBuilder::reward(int feature, double balls) {
    auto const i = static_cast<std::size_t>(feature);
    if (last_exhibitor_[i] == individuals_) return;
    last_exhibitor_[i] = individuals_;
    sums_[i] += balls;
    ++counts_[i];
}

KnowledgeBase KnowledgeBuilder::finish(Provenance provenance) && {
    provenance.individuals = individuals_;
    provenance.windows = windows_;
    std::vector<double> means(sums_.size());
    for (std::size_t i = 0; i < means.size(); ++i) means[i] = sums_[i] / counts_[i];
    searches_.clear();
    FeatureWindows windows = index_->release();
    index_.reset();
    return KnowledgeBase{
        config_,
        std::move(provenance),
        {std::move(windows.bits), std::move(windows.values), std::move(means), std::move(sums_), std::move(counts_)}};
}

}   // namespace lore
