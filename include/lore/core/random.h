#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace lore {

/// Who asks for randomness. The numbers are part of every result: never renumber, only append.
enum class Purpose : std::uint32_t {
    founder = 1,            ///< genes of the random individuals of generation 0
    tournament = 2,         ///< pairing of parents and coins
    mutation = 3,           ///< one child's mutation
    distance = 4,           ///< which behavioral distance serves a period
    tie = 5,                ///< order among equals in sorts and cuts
    randomize = 6,          ///< values of a "KB random"
    bootstrap = 7,          ///< resampling for confidence bands
    permute = 8,            ///< which feature gets which value of a permuted knowledge base
    founder_mutation = 9,   ///< the one mutation of a founder that comes from elsewhere
    clone = 10,             ///< what a founder cloned from a knowledge base imitates, and its random weights
    shaping_turn = 11,      ///< whether the shaping value serves a period in place of a distance
    test = 99               ///< inputs of property tests
};

/// A stream of random numbers that is a function of its purpose and place: Philox-4x32-10 (Salmon et al. 2011) keyed by
/// the run's seed, with the counter {block, slot, generation, purpose}.
///
/// It has no state that would have to be sent or saved: the same child is born for any number of ranks, after a
/// resume, or alone in a debugger. Cheap to make; copy it to replay it. Own distributions, because those of the
/// standard library may differ between implementations.
class Stream {
public:
    Stream(std::uint64_t seed, Purpose purpose, std::uint32_t generation = 0, std::uint32_t slot = 0);

    std::uint32_t bits();
    std::uint64_t bits64();
    /// Uniform in [0, 1), 53 random bits.
    double uniform();
    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// True with probability p; p <= 0 never, p >= 1 always. Draws once in any case.
    bool chance(double p) { return uniform() < p; }
    bool coin() { return (bits() & 1u) != 0; }
    /// Uniform in 0 .. count-1 without bias (Lemire 2019). Precondition: count > 0.
    std::uint32_t below(std::uint32_t count);
    /// Fisher-Yates.
    template <class T>
    void shuffle(std::span<T> items) {
        for (std::size_t i = items.size(); i > 1; --i)
            std::swap(items[i - 1], items[below(static_cast<std::uint32_t>(i))]);
    }

private:
    void refill();

    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;
    std::array<std::uint32_t, 4> block_{};
    int used_ = 4;
};

}   // namespace lore
