#include "pattern_cache.h"
#include "exact_hash.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace lore::exact {

namespace {

constexpr int most_first_slot_bits = 10;
constexpr std::size_t most_key_bytes = std::size_t{16} << 20;

/// A power of two. Half of the slots stay empty.
std::size_t patterns_that_fit(std::size_t words) {
    std::size_t const bytes = 2 * sizeof(std::uint64_t) * std::max<std::size_t>(1, words);
    return std::bit_floor(std::max<std::size_t>(16, most_key_bytes / bytes));
}

}   // namespace

PatternCache::PatternCache(int words, std::size_t most_patterns, std::size_t most_candidates)
    : words_(static_cast<std::size_t>(words)), most_patterns_(std::min(most_patterns, patterns_that_fit(words_))),
      most_candidates_(most_candidates) {
    reset(std::min(most_first_slot_bits, static_cast<int>(std::bit_width(patterns_that_fit(words_)))));
}

void PatternCache::reset(int slot_bits) {
    slot_bits_ = slot_bits;
    std::size_t const slots = std::size_t{1} << slot_bits;
    keys_.assign(slots * words_, 0);
    lists_.assign(slots, {});
    used_.assign(slots, 0);
    patterns_ = 0;
}

std::size_t PatternCache::slot_of(std::uint64_t const* words) const {
    std::size_t const last = (std::size_t{1} << slot_bits_) - 1;
    std::size_t slot = hash_slot(words, nullptr, static_cast<int>(words_), slot_bits_);
    while (used_[slot] &&
           !std::equal(words, words + words_, keys_.begin() + static_cast<std::ptrdiff_t>(slot * words_)))
        slot = (slot + 1) & last;
    return slot;
}

PatternCache::List const* PatternCache::find(std::uint64_t const* words) const {
    std::size_t const slot = slot_of(words);
    return used_[slot] ? &lists_[slot] : nullptr;
}

std::span<Candidate const> PatternCache::add(std::uint64_t const* words, std::span<Candidate const> candidates) {
    if (patterns_ == most_patterns_ || candidates_.size() + candidates.size() > most_candidates_) {
        reset(slot_bits_);
        candidates_.clear();
    } else if (2 * (patterns_ + 1) > used_.size()) {
        grow();
    }
    std::size_t const slot = slot_of(words);
    assert(!used_[slot]);
    std::copy_n(words, words_, keys_.begin() + static_cast<std::ptrdiff_t>(slot * words_));
    used_[slot] = 1;
    ++patterns_;
    lists_[slot] = {static_cast<std::uint32_t>(candidates_.size()), static_cast<std::uint32_t>(candidates.size())};
    candidates_.insert(candidates_.end(), candidates.begin(), candidates.end());
    return this->candidates(lists_[slot]);
}

void PatternCache::grow() {
    auto const keys = std::move(keys_);
    auto const lists = std::move(lists_);
    auto const used = std::move(used_);
    std::size_t const patterns = patterns_;
    reset(slot_bits_ + 1);
    patterns_ = patterns;
    for (std::size_t from = 0; from < used.size(); ++from) {
        if (!used[from]) continue;
        std::uint64_t const* const words = keys.data() + from * words_;
        std::size_t const slot = slot_of(words);
        std::copy_n(words, words_, keys_.begin() + static_cast<std::ptrdiff_t>(slot * words_));
        lists_[slot] = lists[from];
        used_[slot] = 1;
    }
}

}   // namespace lore::exact
