#include "evidence_gatherer.h"

#include <cassert>
#include <utility>

namespace lore {

Evidence view(EvidenceArrays const& arrays) {
    return {arrays.gammas,
            arrays.showings,
            arrays.return_sums,
            arrays.has_credit,
            arrays.news,
            arrays.gain_sums,
            arrays.success_reward,
            arrays.successes,
            arrays.failures,
            arrays.successes_that_showed,
            arrays.failures_that_showed};
}

std::vector<double> discounted_returns(std::span<Reward const> rewards, double gamma, int window_length,
                                       std::size_t windows) {
    std::vector<double> returns(windows, 0.0);
    if (rewards.empty()) return returns;
    double now = 0;
    std::size_t left = rewards.size();
    for (int step = rewards.back().step; step >= 0; --step) {
        now *= gamma;
        for (; left > 0 && rewards[left - 1].step == step; --left) now += static_cast<double>(rewards[left - 1].amount);
        std::size_t const window = static_cast<std::size_t>(step / window_length);
        if (step % window_length == 0 && window < windows) returns[window] = now;
    }
    return returns;
}

EvidenceGatherer::EvidenceGatherer(EvidenceConfig config, int window_length)
    : config_(std::move(config)), window_length_(window_length), return_sums_(config_.gammas.size()),
      returns_(config_.gammas.size()) {}

void EvidenceGatherer::add_feature() {
    if (!config_.gammas.empty()) showings_.push_back(0);
    for (std::vector<double>& sums : return_sums_) sums.push_back(0);
    if (config_.credit) {
        news_.push_back(0);
        gain_sums_.push_back(0);
        last_shown_by_.push_back(0);
    }
    if (config_.success_reward) {
        in_all_.push_back({});
        in_era_.push_back({});
    }
}

void EvidenceGatherer::begin(Exhibit const& exhibit) {
    ++individual_;
    reward_ = exhibit.reward;
    has_returned_ = !exhibit.rewards.empty();
    shown_.clear();
    if (has_returned_)
        for (std::size_t i = 0; i < config_.gammas.size(); ++i)
            returns_[i] =
                discounted_returns(exhibit.rewards, config_.gammas[i], window_length_, exhibit.windows.size());
    int const era = static_cast<int>(exhibit.generation) / generations_per_era;
    if (config_.success_reward && era != era_) end_era();
    era_ = era;
}

void EvidenceGatherer::show(int feature, std::size_t window, bool first) {
    auto const i = static_cast<std::size_t>(feature);
    if (!config_.gammas.empty()) ++showings_[i];
    if (has_returned_)
        for (std::size_t gamma = 0; gamma < config_.gammas.size(); ++gamma)
            return_sums_[gamma][i] += returns_[gamma][window];
    if (first && (config_.credit || config_.success_reward)) shown_.push_back(feature);
}

void EvidenceGatherer::end() {
    if (config_.credit) credit_child();
    if (config_.success_reward) count_in_era();
}

/// This individual is the parent of the one before it.
void EvidenceGatherer::credit_child() {
    for (int const feature : shown_) last_shown_by_[static_cast<std::size_t>(feature)] = individual_;
    for (int const feature : shown_by_child_) {
        auto const i = static_cast<std::size_t>(feature);
        if (last_shown_by_[i] == individual_) continue;
        ++news_[i];
        gain_sums_[i] += child_reward_ - reward_;
    }
    shown_by_child_ = shown_;
    child_reward_ = reward_;
}

void EvidenceGatherer::count_in_era() {
    bool const succeeds = reward_ >= *config_.success_reward;
    ++(succeeds ? era_all_.successes : era_all_.failures);
    for (int const feature : shown_) {
        auto& counts = in_era_[static_cast<std::size_t>(feature)];
        if (counts.successes == 0 && counts.failures == 0) touched_.push_back(feature);
        ++(succeeds ? counts.successes : counts.failures);
    }
}

/// An era in which all or none succeeded has nothing to compare.
void EvidenceGatherer::end_era() {
    bool const counts = era_all_.successes > 0 && era_all_.failures > 0;
    if (counts) {
        successes_ += era_all_.successes;
        failures_ += era_all_.failures;
    }
    for (int const feature : touched_) {
        auto const i = static_cast<std::size_t>(feature);
        if (counts) {
            in_all_[i].successes += in_era_[i].successes;
            in_all_[i].failures += in_era_[i].failures;
        }
        in_era_[i] = {};
    }
    touched_.clear();
    era_all_ = {};
}

EvidenceArrays EvidenceGatherer::finish() && {
    end_era();
    EvidenceArrays arrays;
    arrays.gammas = std::move(config_.gammas);
    arrays.showings = std::move(showings_);
    for (std::vector<double> const& sums : return_sums_)
        arrays.return_sums.insert(arrays.return_sums.end(), sums.begin(), sums.end());
    arrays.has_credit = config_.credit;
    arrays.news = std::move(news_);
    arrays.gain_sums = std::move(gain_sums_);
    arrays.success_reward = config_.success_reward;
    arrays.successes = successes_;
    arrays.failures = failures_;
    for (Counts const& counts : in_all_) {
        arrays.successes_that_showed.push_back(counts.successes);
        arrays.failures_that_showed.push_back(counts.failures);
    }
    return arrays;
}

}   // namespace lore
