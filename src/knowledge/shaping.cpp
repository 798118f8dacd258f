#include <lore/knowledge/shaping.h>

#include <algorithm>
#include <mutex>

namespace lore {

struct Shaper::State {
    explicit State(KnowledgeBase kept) : base(std::move(kept)) {}

    KnowledgeBase base;
    std::unique_ptr<FeatureIndex> index;
    double highest = no_feature_value;
    std::mutex mutex;                                   ///< guards idle
    std::vector<std::unique_ptr<FeatureSearch>> idle;   ///< searches that nobody borrows now
};

struct Shaper::Reader::Loan {
    std::shared_ptr<State> owner;
    std::unique_ptr<FeatureSearch> search;
    double highest;
    std::span<double const> values;
};

Shaper::Shaper(KnowledgeBase base, IndexKind kind) : state_(std::make_shared<State>(std::move(base))) {
    KnowledgeBase const& kept = state_->base;
    state_->index = make_index(kind, kept.config());
    for (int feature = 0; feature < kept.size(); ++feature) state_->index->add(kept.window(feature));
    state_->index->set_values(kept.values());
    for (double const value : kept.values()) state_->highest = std::max(state_->highest, value);
}

KnowledgeBase const& Shaper::base() const { return state_->base; }
double Shaper::highest_value() const { return state_->highest; }

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

void Shaper::Reader::see(Window const& window, ShapingState& state) {
    if (state.best >= loan_->highest) return;
    Match const found = loan_->search->match_above(window, state.best);
    if (found.found()) state.best = std::max(state.best, loan_->values[static_cast<std::size_t>(found.feature)]);
}

bool Shaper::Reader::may_raise(std::span<std::uint16_t const> bits, ShapingState const& state) {
    return state.best < loan_->highest && loan_->search->may_match_above(bits, state.best);
}

Match Shaper::Reader::match(Window const& window) { return loan_->search->match(window); }

double Shaper::Reader::shaping(std::span<Window const> windows) {
    ShapingState state;
    for (Window const& window : windows) see(window, state);
    return state.best;
}

}   // namespace lore
