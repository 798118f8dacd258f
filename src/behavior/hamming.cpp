#include "fast_distances.h"
#include "hamming_kernel.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <limits>
#include <numeric>

namespace lore {

namespace {

using Plane = std::array<std::uint64_t, words_per_plane>;

/// The different planes among those of one channel and stretch of time. In a population there are few: a sensor
/// that shows nothing to anyone, an effector that all hold, a child that has not yet left its parent's way. Measured on
/// evolved populations, only 7 to 15 % of the pairs of planes are left to count.
class PlaneClasses {
public:
    explicit PlaneClasses(std::size_t members) : class_of_(members), slots_(std::bit_ceil(2 * members)) {}

    void classify(std::span<Plane const> planes) {
        std::fill(slots_.begin(), slots_.end(), 0);
        representatives_.clear();
        for (std::size_t member = 0; member < planes.size(); ++member)
            class_of_[member] = class_of(planes, static_cast<int>(member));
    }

    std::span<int const> class_of() const { return class_of_; }
    std::span<int const> representatives() const { return representatives_; }

private:
    static std::size_t hash(Plane const& plane) {
        std::uint64_t sum = 0, factor = 0x9e3779b97f4a7c15u;
        for (std::uint64_t const word : plane) {
            sum += (word ^ (word >> 32)) * factor;
            factor += 0x3c6ef372fe94f82au;   // stays odd
        }
        return static_cast<std::size_t>(sum >> 40);
    }

    int class_of(std::span<Plane const> planes, int member) {
        std::size_t const mask = slots_.size() - 1;
        for (std::size_t slot = hash(planes[member]) & mask;; slot = (slot + 1) & mask) {
            if (slots_[slot] == 0) {
                representatives_.push_back(member);
                slots_[slot] = static_cast<int>(representatives_.size());
            }
            int const known = slots_[slot] - 1;
            if (planes[representatives_[known]] == planes[member]) return known;
        }
    }

    std::vector<int> class_of_, representatives_;
    std::vector<int> slots_;   ///< class + 1, or 0
};

std::size_t steps_of(Descriptors const& d) { return static_cast<std::size_t>(d.steps()); }

/// Counts differing bits between rows [first, size) and all members, plane by plane.
class DifferenceCounts {
public:
    DifferenceCounts(std::span<Descriptors const* const> pool, int first, std::size_t longest)
        : pool_(pool), first_(static_cast<std::size_t>(first)), channels_(pool[0]->channels()),
          words_(static_cast<std::size_t>(pool[0]->words())),
          kernel_(kernel_for(active_isa(), LORE_KERNELS(hamming))(true)),
          planes_(pool.size() * static_cast<std::size_t>(std::min(channels_, channels_of_word)) * sizeof(Plane) /
                  sizeof(CacheLine)),
          classes_(pool.size()), short_sums_((pool.size() - first_) * pool.size()), terms_(pool.size()) {
        for (std::size_t start = 0; start < longest; start += steps_per_plane)
            for (std::size_t word = 0; word < words_; ++word) count_stretch(start, word);
        widen();
    }

    /// Of row i against members 0 .. i-1.
    std::uint32_t const* row(int i) const { return &sums_[(static_cast<std::size_t>(i) - first_) * pool_.size()]; }

private:
    /// The channels of one word of every step, over the stretch of time that begins with step `start`.
    void count_stretch(std::size_t start, std::size_t word) {
        std::size_t const members = pool_.size();
        int const channels = std::min(channels_ - static_cast<int>(word) * channels_of_word, channels_of_word);
        int const most = channels * steps_per_plane;
        if (in_short_sums_ + most > std::numeric_limits<std::uint16_t>::max()) widen();
        in_short_sums_ += most;
        Plane* const planes = reinterpret_cast<Plane*>(planes_.data());   // [channel][member]
        for (std::size_t member = 0; member < members; ++member)
            kernel_.split(words_from(*pool_[member], start, word), planes[member].data(),
                          static_cast<std::ptrdiff_t>(members * words_per_plane), channels);
        for (int channel = 0; channel < channels; ++channel)
            count_channel({planes + static_cast<std::size_t>(channel) * members, members});
    }

    /// That word of steps_per_plane steps, one after the other; valid until the next call.
    std::uint16_t const* words_from(Descriptors const& member, std::size_t start, std::size_t word) {
        std::size_t const steps = steps_of(member), lived = std::min(start, steps),
                          left = std::min(steps - lived, std::size_t{steps_per_plane});
        std::uint16_t const* const bits = member.channel_bits.data();
        if (words_ == 1 && left == steps_per_plane) return bits + lived;
        for (std::size_t step = 0; step < left; ++step) gathered_[step] = bits[(lived + step) * words_ + word];
        std::fill(gathered_.begin() + static_cast<std::ptrdiff_t>(left), gathered_.end(), std::uint16_t{0});
        return gathered_.data();
    }

    void count_channel(std::span<Plane const> planes) {
        classes_.classify(planes);
        std::span<int const> const class_of = classes_.class_of(), representatives = classes_.representatives();
        if (representatives.size() == 1) return;

        std::size_t const lanes = static_cast<std::size_t>(kernel_.lanes),
                          groups = (representatives.size() + lanes - 1) / lanes;
        others_.resize(groups * lanes * sizeof(Plane) / sizeof(CacheLine));
        auto* const others = reinterpret_cast<std::uint64_t*>(others_.data());   // [group][word][lane]
        for (std::size_t k = 0; k < representatives.size(); ++k)
            for (std::size_t word = 0; word < words_per_plane; ++word)
                others[(k / lanes * words_per_plane + word) * lanes + k % lanes] = planes[representatives[k]][word];

        rows_of_.resize(std::max(rows_of_.size(), representatives.size()));
        for (std::size_t k = 0; k < representatives.size(); ++k) rows_of_[k].clear();
        for (std::size_t i = first_; i < planes.size(); ++i) rows_of_[class_of[i]].push_back(i);
        counts_.resize(groups * lanes);
        for (std::size_t k = 0; k < representatives.size(); ++k) {
            if (rows_of_[k].empty()) continue;
            kernel_.differing(planes[representatives[k]].data(), others, static_cast<int>(groups), counts_.data());
            kernel_.spread(counts_.data(), class_of.data(), static_cast<int>(planes.size()), terms_.data());
            for (std::size_t const i : rows_of_[k])
                kernel_.add(terms_.data(), static_cast<int>(i), &short_sums_[(i - first_) * planes.size()]);
        }
    }

    /// Adds the short sums to the sums.
    void widen() {
        if (sums_.empty()) sums_.assign(short_sums_.begin(), short_sums_.end());
        else std::transform(sums_.begin(), sums_.end(), short_sums_.begin(), sums_.begin(), std::plus<std::uint32_t>{});
        std::fill(short_sums_.begin(), short_sums_.end(), std::uint16_t{0});
        in_short_sums_ = 0;
    }

    std::span<Descriptors const* const> pool_;
    std::size_t first_;
    int channels_;
    std::size_t words_;   ///< a step
    HammingKernel kernel_;
    std::array<std::uint16_t, steps_per_plane> gathered_{};   ///< zeros after an evaluation's end
    std::vector<CacheLine> planes_, others_;
    PlaneClasses classes_;
    std::vector<std::vector<std::size_t>> rows_of_;   ///< by class
    std::vector<std::uint32_t> sums_;                 ///< [row - first][member]
    std::vector<std::uint16_t> short_sums_;           ///< the same, of the last stretches; through them all counts go
    int in_short_sums_ = 0;                           ///< the most that any of them can be
    std::vector<std::uint32_t> counts_;
    std::vector<std::uint16_t> terms_;
};

/// Set bits before each step, and among all: a sum that every pair of evaluations of different lengths asks for.
std::vector<std::uint32_t> ones_before(Descriptors const& d) {
    std::size_t const words = static_cast<std::size_t>(d.words());
    std::vector<std::uint32_t> ones(steps_of(d) + 1);
    for (std::size_t i = 0; i < d.channel_bits.size(); ++i)
        ones[i / words + 1] += static_cast<std::uint32_t>(std::popcount(d.channel_bits[i]));
    std::partial_sum(ones.begin(), ones.end(), ones.begin());
    return ones;
}

}   // namespace

void measure_hamming_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix& matrix) {
    if (first >= last) return;
    pool = pool.first(static_cast<std::size_t>(last));
    std::size_t const bits_per_step = static_cast<std::size_t>(pool[0]->channels());
    std::vector<std::size_t> steps;
    for (Descriptors const* d : pool) {
        assert(d->channels() == pool[0]->channels());
        steps.push_back(steps_of(*d));
    }
    auto const [shortest, longest_of_all] = std::minmax_element(steps.begin(), steps.end());
    std::size_t const longest = *longest_of_all;
    bool const all_alike = *shortest == longest && longest > 0;
    DifferenceCounts const differences(pool, first, longest);
    std::vector<std::vector<std::uint32_t>> ones(pool.size());   // only of members that live longer than another
    for (int i = first; i < last; ++i) {
        std::uint32_t const* const counts = differences.row(i);
        double* const row = matrix.row(i);
        if (all_alike) {   // the usual case, many divisions at a time
            double const bits = static_cast<double>(longest * bits_per_step);
            for (int j = 0; j < i; ++j) row[j] = static_cast<double>(counts[j]) / bits;
            continue;
        }
        for (int j = 0; j < i; ++j) {
            int const outliving = steps[i] >= steps[j] ? i : j;
            std::size_t const length = std::max(steps[i], steps[j]), common = std::min(steps[i], steps[j]);
            std::size_t count = counts[j];
            // After the end of the shorter, the longer was compared with zeros; by definition all bits differ there.
            if (length != common) {
                std::vector<std::uint32_t>& before = ones[outliving];
                if (before.empty()) before = ones_before(*pool[outliving]);
                count = count - (before[length] - before[common]) + (length - common) * bits_per_step;
            }
            row[j] = length == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(length * bits_per_step);
        }
    }
}

}   // namespace lore
