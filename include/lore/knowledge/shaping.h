#pragma once

#include <lore/knowledge/index.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace lore {

/// What stands for RS without a knowledge base, and by rule max for that of somebody who shows no feature of a base
/// whose values are all larger (Shaper::nothing_shown).
inline constexpr double no_feature_value = -1.0;

/// How the features that an individual shows become one number, RS(x); v_b is the value of feature b.
enum class ShapingRule : std::uint8_t {
    max,        ///< the largest v_b among them (paper, "Knowledge exploitation")
    distinct,   ///< the sum of v_b over the different features shown
    sum,        ///< the sum of v_b over all showings: a feature shown twice counts twice
    share       ///< the sum of v_b (1 - f_b) over the different features shown, f_b the share of the pool that shows b:
                ///< a feature that all show is worth nothing, so that the objective cannot saturate
};
std::string_view name(ShapingRule);
ShapingRule shaping_rule(std::string_view name);   ///< throws UsageError

/// What the windows of one individual, seen one after the other, have shown so far.
struct ShapingState {
    /// Rule max: the largest value shown; below every number as long as no feature was.
    double best = -std::numeric_limits<double>::infinity();
    double sum = 0;                     ///< rule sum: RS of the windows seen
    std::vector<std::uint32_t> shown;   ///< rules distinct and share: the features matched, a showing each
};

/// The reward shaping objective RS (paper, "Knowledge exploitation"): a knowledge base and its index, read only,
/// safe to use from several threads. Cheap to copy; copies share everything.
class Shaper {
public:
    explicit Shaper(KnowledgeBase, ShapingRule = ShapingRule::max, IndexChoice = IndexKind::exact);
    KnowledgeBase const& base() const;
    ShapingRule rule() const;
    double highest_value() const;   ///< -infinity for an empty base
    /// RS by rule max of somebody who shows no feature: less than any value of the base, so that showing nothing ranks
    /// below showing anything (paper). It is no_feature_value, -1, unless the base has a value of -1 or less: then one
    /// less than the smallest.
    double nothing_shown() const;

    /// One user's access, with a search of its own, for one thread at a time. Borrowed from the Shaper and given back
    /// by the destructor, so that the search's cache serves the next user.
    class Reader {
    public:
        Reader(Reader&&) noexcept;
        Reader& operator=(Reader&&) = delete;
        ~Reader();
        /// Adds what the window shows to the state, as often as `times` says. By rule max only features worth more
        /// than state.best are looked for, which costs little once it is high; by the others the nearest feature of
        /// every window is found.
        void see(Window const&, ShapingState&, int times = 1);
        /// False if see() would leave the state as it is for every window with these bits, whatever its values.
        bool may_matter(std::span<std::uint16_t const> bits, ShapingState const&);
        /// RS of all windows seen; by rule share, which needs the pool, no_feature_value. Leaves state.shown in
        /// increasing order, each feature once.
        double value(ShapingState&) const;
        /// The nearest feature within the threshold, if any.
        Match match(Window const&);
        /// RS of the windows: value() after all have been seen.
        double shaping(std::span<Window const>);

    private:
        friend class Shaper;
        explicit Reader(Shaper const&);
        struct Loan;
        std::unique_ptr<Loan> loan_;
    };
    Reader reader() const { return Reader{*this}; }

    /// As Reader's, for a single question.
    double shaping(std::span<Window const> windows) const { return reader().shaping(windows); }
    Match match(Window const& window) const { return reader().match(window); }

private:
    struct State;
    std::shared_ptr<State> state_;
};

}   // namespace lore
