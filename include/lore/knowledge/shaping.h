#pragma once

#include <lore/knowledge/index.h>

namespace lore {

inline constexpr double no_feature_value = -1.0;

/// What the windows of one individual, seen one after the other, have been worth so far.
struct ShapingState {
    double best = no_feature_value;   ///< RS of the windows seen
};

/// The reward shaping objective RS (paper, "Knowledge exploitation"): a knowledge base and its index, read only,
/// safe to use from several threads. Cheap to copy; copies share everything.
class Shaper {
public:
    explicit Shaper(KnowledgeBase, IndexKind = IndexKind::exact);
    KnowledgeBase const& base() const;
    double highest_value() const;   ///< no_feature_value for an empty base

    /// One user's access, with a search of its own, for one thread at a time. Borrowed from the Shaper and given back
    /// by the destructor, so that what the search has cached serves the next user.
    class Reader {
    public:
        Reader(Reader&&) noexcept;
        Reader& operator=(Reader&&) = delete;
        ~Reader();
        /// state.best becomes the value of the window's nearest feature, if it matches one that is worth more. Costs
        /// little once state.best is high: only features worth more are looked for.
        void see(Window const&, ShapingState&);
        /// False if see() would leave state.best as it is for every window with these bits, whatever its values.
        bool may_raise(std::span<std::uint16_t const> bits, ShapingState const&);
        /// The nearest feature within the threshold, if any.
        Match match(Window const&);
        /// The largest value among the features that the windows match; -1 if none matches.
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
