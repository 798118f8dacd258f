#include "evidence_gatherer.h"

#include <lore/knowledge/value.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>
#include <future>
#include <numeric>

namespace lore {

namespace {

/// Indices of windows in an order that puts those with the same bits next to each other: one after the other they read
/// the same memory of an index, and the match of one is a good first guess for the next.
std::vector<std::size_t> alike_together(std::span<Window const* const> windows) {
    std::vector<std::size_t> order(windows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        auto const &left = windows[a]->bits, &right = windows[b]->bits;
        int const difference = std::memcmp(left.data(), right.data(), left.size_bytes());
        return difference != 0 ? difference < 0 : a < b;
    });
    return order;
}

}   // namespace

KnowledgeBuilder::KnowledgeBuilder(KnowledgeConfig config, std::unique_ptr<FeatureIndex> index, EvidenceConfig evidence)
    : config_(config), index_(std::move(index)) {
    assert(index_->size() == 0);
    bool const wanted = !evidence.gammas.empty() || evidence.credit || evidence.success_reward;
    if (wanted) evidence_ = std::make_unique<EvidenceGatherer>(std::move(evidence), config.window_length);
    searches_.push_back(index_->search());
}

KnowledgeBuilder::~KnowledgeBuilder() = default;
KnowledgeBuilder::KnowledgeBuilder(KnowledgeBuilder&&) noexcept = default;

void KnowledgeBuilder::begin_individual(Exhibit const& exhibit) {
    ++individuals_;   // numbers individuals from 1, so that 0 in last_exhibitor_ is no individual
    windows_ += exhibit.windows.size();
    if (evidence_) evidence_->begin(exhibit);
}

void KnowledgeBuilder::add_individual(Exhibit const& exhibit) {
    begin_individual(exhibit);
    for (std::size_t i = 0; i < exhibit.windows.size(); ++i) {
        Window const& window = exhibit.windows[i];
        int feature = searches_.front()->match(window).feature;
        if (feature >= 0) {
            ++matched_;
        } else {
            index_->add(window);
            feature = add_feature();
        }
        show(feature, i, exhibit.reward);
    }
    if (evidence_) evidence_->end();
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
        begin_individual(exhibit);
        for (std::size_t i = 0; i < exhibit.windows.size(); ++i) {
            Window const& window = exhibit.windows[i];
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
            show(match.feature, i, exhibit.reward);
        }
        if (evidence_) evidence_->end();
    }
    for (Window const* window : added) index_->add(*window);
}

std::vector<Match> KnowledgeBuilder::match_all(std::span<Window const* const> windows, int threads) {
    constexpr std::size_t share = 3200;   // windows that a thread takes at once, many because neighbors are alike
    std::vector<Match> matches(windows.size());
    std::vector<std::size_t> const order = alike_together(windows);
    std::atomic<std::size_t> taken{0};
    auto const work = [&](FeatureSearch& search) {
        for (std::size_t first; (first = taken.fetch_add(share)) < windows.size();)
            for (std::size_t i = first; i < std::min(first + share, windows.size()); ++i)
                matches[order[i]] = search.match(*windows[order[i]]);
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
    if (evidence_) evidence_->add_feature();
    return features() - 1;
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
    searches_.clear();
    FeatureWindows windows = index_->release();
    index_.reset();
    return KnowledgeBase{config_,
                         std::move(provenance),
                         {std::move(windows.bits), std::move(windows.values), std::move(means), std::move(sums_),
                          std::move(counts_), evidence_ ? std::move(*evidence_).finish() : EvidenceArrays{}}};
}

}   // namespace lore
