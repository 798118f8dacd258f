#include <lore/knowledge/shaping.h>

#include <lore/core/names.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace lore {

namespace {

constexpr auto shaping_rule_names = names_for<ShapingRule>("max", "distinct", "sum", "share");

}   // namespace

std::string_view name(ShapingRule rule) { return shaping_rule_names[rule]; }

ShapingRule shaping_rule(std::string_view wanted) { return shaping_rule_names.choice(wanted, "a shaping rule"); }

struct Shaper::State {
    State(KnowledgeBase kept, ShapingRule wanted) : base(std::move(kept)), rule(wanted) {}

    KnowledgeBase base;
    ShapingRule rule;
    std::unique_ptr<FeatureIndex> index;
    double highest = -std::numeric_limits<double>::infinity();
    double nothing_shown = no_feature_value;
    std::mutex mutex;                                   ///< guards idle
    std::vector<std::unique_ptr<FeatureSearch>> idle;   ///< searches that are not lent now
};

struct Shaper::Reader::Loan {
    std::shared_ptr<State> owner;
    std::unique_ptr<FeatureSearch> search;
    double highest;
    std::span<double const> values;
};

Shaper::Shaper(KnowledgeBase base, ShapingRule rule, IndexChoice index)
    : state_(std::make_shared<State>(std::move(base), rule)) {
    KnowledgeBase const& kept = state_->base;
    state_->index = make_final_index(index, kept);
    double lowest = 0;
    for (double const value : kept.values()) {
        state_->highest = std::max(state_->highest, value);
        lowest = std::min(lowest, value);
    }
    if (lowest <= no_feature_value) state_->nothing_shown = lowest - 1;
}

KnowledgeBase const& Shaper::base() const { return state_->base; }
ShapingRule Shaper::rule() const { return state_->rule; }
double Shaper::highest_value() const { return state_->highest; }
double Shaper::nothing_shown() const { return state_->nothing_shown; }

Shaper::Reader::Reader(Shaper const& shaper) : loan_(std::make_unique<Loan>()) {
    State& state = *shaper.state_;
    loan_->owner = shaper.state_;
    loan_->highest = state.highest;
    loan_->values = state.base.values();
    {
        std::lock_guard const lock{state.mutex};
        if (!state.idle.empty()) {
            loan_->search = std::move(state.idle.back());
            state.idle.pop_back();
        }
    }
    if (loan_->search == nullptr) loan_->search = state.index->search();
}

Shaper::Reader::Reader(Reader&&) noexcept = default;

Shaper::Reader::~Reader() {
    if (loan_ == nullptr) return;
    std::lock_guard const lock{loan_->owner->mutex};
    loan_->owner->idle.push_back(std::move(loan_->search));
}

void Shaper::Reader::see(Window const& window, ShapingState& state, int times) {
    if (loan_->owner->rule == ShapingRule::max) {
        if (state.best >= loan_->highest) return;
        Match const found = loan_->search->match_above(window, state.best);
        if (found.found()) state.best = std::max(state.best, loan_->values[static_cast<std::size_t>(found.feature)]);
        return;
    }
    Match const found = loan_->search->match(window);
    if (!found.found()) return;
    if (loan_->owner->rule == ShapingRule::sum)
        for (int showing = 0; showing < times; ++showing)
            state.sum += loan_->values[static_cast<std::size_t>(found.feature)];
    else state.shown.push_back(static_cast<std::uint32_t>(found.feature));
}

bool Shaper::Reader::may_matter(std::span<std::uint16_t const> bits, ShapingState const& state) {
    if (loan_->owner->rule == ShapingRule::max)
        return state.best < loan_->highest && loan_->search->may_match_above(bits, state.best);
    return loan_->search->may_match_above(bits, -std::numeric_limits<double>::infinity());
}

double Shaper::Reader::value(ShapingState& state) const {
    std::sort(state.shown.begin(), state.shown.end());
    state.shown.erase(std::unique(state.shown.begin(), state.shown.end()), state.shown.end());
    switch (loan_->owner->rule) {
    case ShapingRule::max: return std::isinf(state.best) ? loan_->owner->nothing_shown : state.best;
    case ShapingRule::sum: return state.sum;
    case ShapingRule::share: return no_feature_value;
    case ShapingRule::distinct: break;
    }
    double sum = 0;
    for (std::uint32_t const feature : state.shown) sum += loan_->values[feature];
    return sum;
}

Match Shaper::Reader::match(Window const& window) { return loan_->search->match(window); }

double Shaper::Reader::shaping(std::span<Window const> windows) {
    ShapingState state;
    for (Window const& window : windows) see(window, state);
    return value(state);
}

}   // namespace lore
