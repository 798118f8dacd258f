#pragma once

#include <lore/knowledge/index.h>

namespace lore {

inline constexpr double no_feature_value = -1.0;

/// The reward shaping objective RS (paper, "Knowledge exploitation"): a knowledge base and its index, read only,
/// safe to use from several threads.
class Shaper {
public:
    explicit Shaper(KnowledgeBase, IndexKind = IndexKind::exact);
    KnowledgeBase const& base() const;
    /// The largest value among the features that the windows match; -1 if none matches.
    double shaping(std::span<Window const>) const;
    /// Value of one window: its feature's, or -1.
    Match match(Window const&) const;
    double highest_value() const;

private:
    struct State;
    std::shared_ptr<State const> state_;
};

} // namespace lore
