#pragma once

#include <lore/episode/aligned_floats.h>
#include <lore/episode/lane_rules.h>
#include <lore/episode/lane_run.h>

#include <array>
#include <memory>
#include <vector>

namespace lore {

/// Lives of a world that is written as rules, in lanes: everything but what the rules say.
class RulesLives : public LaneLives {
public:
    using Kernel = void(LaneRulesWork const&);
    /// `start`: the members of State<float>. The rules outlive it.
    RulesLives(void const* rules, Kernel* kernel, std::span<float const> start);
    void begin(int lane) final;
    void run(LaneBuffers const&, int rows, std::span<LaneProgress>, std::vector<LaneReward>&) final;

protected:
    /// Writes a member of State<float> after the other.
    void put_state(int lane, std::span<float> members) const;

private:
    void const* rules_;
    Kernel* kernel_;
    int width_;
    std::vector<float> start_;
    AlignedFloats states_, rewards_;
    alignas(64) std::array<std::int32_t, most_lanes> rows_{}, over_{};
};

/// A world that is written as rules (lane_rules.h) once, for a life alone and for lanes.
///
/// The kernel of an instruction set calls run_rules<Rules, LORE_LANES>.
template <class Rules>
class RulesWorld : public LaneWorld {
public:
    using State = typename Rules::template State<float>;

    /// `kernel`: of the instruction set that is active, whenever lanes begin. Precondition: the facts have the channels
    /// of the rules.
    RulesWorld(WorldFacts facts, Rules const& rules, RulesLives::Kernel* (*kernel)())
        : facts_(std::move(facts)), rules_(rules), kernel_(kernel) {}

    WorldFacts const& facts() const override { return facts_; }
    Rules const& rules() const { return rules_; }
    std::unique_ptr<Life> begin() const override { return std::make_unique<PlainLife>(rules_); }
    void run_in_lanes(EpisodeConfig const& config, int chunk_steps, LaneClient& client) const override {
        StatesInLanes lives{rules_, kernel_()};
        run_lives(lives, facts_, config, chunk_steps, client);
    }

private:
    static_assert(sizeof(State) % sizeof(float) == 0);
    using Members = std::array<float, sizeof(State) / sizeof(float)>;

    class PlainLife final : public Life {
    public:
        explicit PlainLife(Rules const& rules) : rules_(rules), state_(rules.start()) {}
        Position sense(std::span<float> sensors) const override {
            rules_.sense(state_, sensors.data());
            return {state_.x, state_.y};
        }
        StepResult act(std::span<float const> effectors) override {
            LaneStep<float> const step = rules_.act(state_, effectors.data());
            return {step.reward, step.over};
        }
        void outcome(std::span<float> values) const override { rules_.outcome(state_, values.data()); }

    private:
        Rules const& rules_;
        State state_;
    };

    class StatesInLanes final : public RulesLives {
    public:
        StatesInLanes(Rules const& rules, Kernel* kernel)
            : RulesLives(&rules, kernel, lanes::cast_bits<Members>(rules.start())), rules_(rules) {}
        void outcome(int lane, std::span<float> values) const override {
            Members members;
            put_state(lane, members);
            rules_.outcome(lanes::cast_bits<State>(members), values.data());
        }

    private:
        Rules const& rules_;
    };

    WorldFacts facts_;
    Rules rules_;
    RulesLives::Kernel* (*kernel_)();
};

}   // namespace lore
