#pragma once

#include "exact_kernel.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lore::exact {

/// Remembers which features are within reach of a bit pattern. When it is full it forgets everything and starts anew:
/// what matters comes back within a generation.
class PatternCache {
public:
    /// Where a pattern's candidates are.
    struct List {
        std::uint32_t start;
        std::uint32_t count;
    };

    /// With 16 candidates a pattern, as usual, both limits are reached together: at about 25 MB with patterns of three
    /// words. Of longer ones it holds fewer, so that these take no more than 16 MB themselves, or 16 of them.
    explicit PatternCache(int words, std::size_t most_patterns = 1u << 16, std::size_t most_candidates = 1u << 20);

    /// Null if the pattern is not known. Valid until the next add.
    List const* find(std::uint64_t const* words) const;
    std::span<Candidate const> candidates(List const& list) const {
        return {candidates_.data() + list.start, list.count};
    }
    /// Precondition: the pattern is not known. Returns the copy that is kept, valid until the next add.
    std::span<Candidate const> add(std::uint64_t const* words, std::span<Candidate const>);
    std::size_t size() const { return patterns_; }

private:
    /// The slot of a pattern, or the empty one where it would be.
    std::size_t slot_of(std::uint64_t const* words) const;
    void reset(int slot_bits);
    void grow();

    std::size_t words_, most_patterns_, most_candidates_;
    int slot_bits_ = 0;
    std::vector<std::uint64_t> keys_;   ///< [slot][word]
    std::vector<List> lists_;           ///< [slot]
    std::vector<std::uint8_t> used_;    ///< [slot]
    std::vector<Candidate> candidates_;
    std::size_t patterns_ = 0;
};

}   // namespace lore::exact
