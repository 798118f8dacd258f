#pragma once

#include <lore/episode/lane_buffers.h>

#include <cstdint>

/// Lanes for worlds that are written as rules: for kernels (tools/cmake/LoreTargets.cmake, lore_kernel). RulesWorld
/// makes a world of rules and such a kernel.
///
/// Rules are a plain struct of constants with the formulas of a step, each one template for a float and for a vector of
/// floats (core/lanes.h), so that a life alone and many side by side give the same bits:
///
///     template <class F> struct State { F x, y, ...; };             // all that a life changes: nothing but Fs
///     static constexpr int sensors, effectors;
///     static constexpr bool binary[sensors + effectors];
///     State<float> start() const;
///     template <class F> void sense(State<F> const&, F* sensors) const;
///     template <class F> LaneStep<F> act(State<F>&, F const* effectors) const;
///     void outcome(State<float> const&, float* values) const;
///
/// None of them branches on the data of a life, and all are LORE_INLINE.
namespace lore {

/// What a step gives: Life::act.
template <class F>
struct LaneStep {
    F reward;
    MaskOf<F> over;
};

/// The lives of a kernel. Arrays are [lane] or [..][lane], in rows as those of LaneBuffers.
struct LaneRulesWork {
    void const* rules;
    int row_count;        ///< steps to run
    float* states;        ///< [member][lane]
    std::int32_t* rows;   ///< LaneProgress::rows
    std::int32_t* over;   ///< LaneProgress::over, 0 or -1
    float* rewards;       ///< [row][lane]; 0 beyond a lane's rows
    LaneBuffers buffers;
};

namespace lane_rules {

/// Where each channel is recorded.
template <class Rules>
struct Places {
    static constexpr int channels = Rules::sensors + Rules::effectors;
    static constexpr int words = (channels + 15) / 16;
    int bit[channels]{};      ///< in Trace::channel_bits
    int column[channels]{};   ///< in LaneChunk::values, of a continuous one
    int continuous = 0;       ///< so many are
    consteval Places() {
        int next = 0;
        for (int c = 0; c < channels; ++c)
            if (Rules::binary[c]) bit[c] = next++;
        for (int c = 0; c < channels; ++c)
            if (!Rules::binary[c]) {
                bit[c] = next++;
                column[c] = continuous++;
            }
    }
};

template <class Rules, class F>
inline constexpr int members = sizeof(typename Rules::template State<F>) / sizeof(F);

template <class Rules, int width>
LORE_INLINE auto load_state(float const* from) {
    using F = Lanes<float, width>;
    F held[members<Rules, F>];
    for (int m = 0; m < members<Rules, F>; ++m) held[m] = lanes::load<F>(from + m * width * lane_vectors);
    return lanes::cast_bits<typename Rules::template State<F>>(held);
}

/// Where `mask` is set; other lanes stay as they are.
template <int width, class State, class I>
LORE_INLINE void store_state(float* to, State const& state, I const& mask) {
    using F = Lanes<float, width>;
    constexpr int count = sizeof(State) / sizeof(F);
    struct Members {
        F all[count];
    };
    auto const held = lanes::cast_bits<Members>(state);
    for (int m = 0; m < count; ++m) {
        float* const place = to + m * width * lane_vectors;
        lanes::store(place, lanes::select(mask, held.all[m], lanes::load<F>(place)));
    }
}

/// One step of one vector, whose lanes start at `at`.
template <class Rules, int width>
class StepOfVector {
public:
    LORE_INLINE StepOfVector(LaneRulesWork const& work, int step, int at)
        : work_(work), rules_(*static_cast<Rules const*>(work.rules)), step_(step), at_(at) {}

    LORE_INLINE void sense() {
        LaneBuffers const& to = work_.buffers;
        auto const state = load_state<Rules, width>(work_.states + at_);
        F sensors[Rules::sensors];
        rules_.sense(state, sensors);
        for (int s = 0; s < Rules::sensors; ++s) {
            lanes::store(to.neurons + s * row + at_, sensors[s]);
            record(s, sensors[s]);
        }
        lanes::store(to.x + step_ * row + at_, state.x);
        lanes::store(to.y + step_ * row + at_, state.y);
    }

    LORE_INLINE void act(float const* outputs) {
        F effectors[Rules::effectors];
        for (int e = 0; e < Rules::effectors; ++e) {
            effectors[e] = lanes::load<F>(outputs + e * row + at_);
            if (Rules::binary[Rules::sensors + e])
                effectors[e] = lanes::select(effectors[e] > 0.5f, lanes::all_of<F>(1.0f), F{});
            record(Rules::sensors + e, effectors[e]);
        }
        for (int w = 0; w < places.words; ++w)
            lanes::store(work_.buffers.words + (step_ * places.words + w) * row + at_,
                         __builtin_convertvector(words_[w], Lanes<std::uint16_t, width>));
        auto state = load_state<Rules, width>(work_.states + at_);
        LaneStep<F> const result = rules_.act(state, effectors);
        I const rows = lanes::load<I>(work_.rows + at_), lives = rows > step_, ends = lives & result.over;
        store_state<width>(work_.states + at_, state, lives);
        lanes::store(work_.rewards + step_ * row + at_, lanes::select(lives, result.reward, F{}));
        lanes::store(work_.rows + at_, lanes::select(ends, lanes::all_of<I>(step_ + 1), rows));
        lanes::store(work_.over + at_, lanes::load<I>(work_.over + at_) | ends);
    }

private:
    using F = Lanes<float, width>;
    using I = Lanes<std::int32_t, width>;
    static constexpr int row = width * lane_vectors;
    static constexpr Places<Rules> places{};

    LORE_INLINE void record(int channel, F const& value) {
        int const bit = places.bit[channel];
        words_[bit / 16] |= (value > 0.5f) & (1 << bit % 16);
        if (!Rules::binary[channel])
            lanes::store(work_.buffers.values + (step_ * places.continuous + places.column[channel]) * row + at_,
                         value);
    }

    LaneRulesWork const& work_;
    Rules const& rules_;
    int step_, at_;
    I words_[places.words]{};   ///< Trace::channel_bits
};

template <class Rules, int width, int vectors>
LORE_INLINE void run(LaneRulesWork const& work) {
    static_assert(lane_vectors == 2);
    alignas(64) float outputs[Rules::effectors * width * lane_vectors];
    LaneNeurons const neurons{work.buffers.neurons, work.buffers.next_hidden};
    for (int step = 0; step < work.row_count; ++step) {
        StepOfVector<Rules, width> first{work, step, 0}, second{work, step, width};
        first.sense();
        if (vectors == 2) second.sense();
        tick_lanes<width, vectors>(work.buffers.networks, Rules::sensors, Rules::effectors, neurons, outputs);
        first.act(outputs);
        if (vectors == 2) second.act(outputs);
    }
}

}   // namespace lane_rules

/// Steps the lanes, in native vectors of `width` lanes.
template <class Rules, int width>
LORE_INLINE void run_rules(LaneRulesWork const& work) {
    if (work.buffers.vectors == 1) lane_rules::run<Rules, width, 1>(work);
    else lane_rules::run<Rules, width, lane_vectors>(work);
}

}   // namespace lore
