#include <lore/collectball/collectball.h>

#include <lore/core/isa.h>
#include <lore/episode/lane_networks.h>

#include "lane_arena.h"
#include "lane_work.h"
#include "stillness.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace lore {

namespace {

static_assert(lane_slots == most_lanes);

using RunSteps = void (*)(LaneWork&, int first, int last);

/// The lanes, each filled by the client whenever it is idle.
class LaneRun {
public:
    LaneRun(Arena const& arena, int stop_when_still, int steps, int chunk_steps, LaneClient& client)
        : arena_(arena), stop_when_still_(stop_when_still), steps_(steps), chunk_steps_(chunk_steps), client_(client),
          width_(lane_count()), run_steps_(kernel_for(active_isa(), LORE_KERNELS(run_steps))), arena_layout_(arena) {
        auto const columns = static_cast<std::size_t>(width_), rows = static_cast<std::size_t>(chunk_steps_);
        values_.assign_zeros(rows * continuous_count * columns);
        trail_x_.assign_zeros(rows * columns);
        trail_y_.assign_zeros(rows * columns);
        words_.resize(rows * columns + most_lanes);
        neurons_.assign_zeros((sensor_count + most_hidden) * columns);
        next_hidden_.assign_zeros(most_hidden * columns);
        work_.arena = arena_layout_.view();
        work_.neurons = neurons_.data();
        work_.next_hidden = next_hidden_.data();
        work_.values = values_.data();
        work_.words = words_.data();
        work_.trail_x = trail_x_.data();
        work_.trail_y = trail_y_.data();
        work_.owner = this;
        work_.act = [](LaneWork& work, int lane, float collect) {
            static_cast<LaneRun*>(work.owner)->act_plainly(lane, collect);
        };
    }

    void run() {
        for (int lane = 0; lane < width_; ++lane) reset(lane);
        while (true) {
            fill_idle_lanes();
            if (running_ == 0) return;
            if (networks_changed_) lay_networks();
            auto const idle = [](Lane const& lane) { return lane.idle(); };
            bool const one_is_enough = std::all_of(lanes_.begin() + width_ / lane_vectors, lanes_.end(), idle);
            work_.vectors = one_is_enough ? 1 : lane_vectors;
            run_chunk();
        }
    }

private:
    struct Lane {
        Network const* network = nullptr;   ///< null: idle
        int steps_left = 0;
        int still_steps = 0;
        int valid = 0;   ///< rows of this chunk
        WorldState world;
        bool idle() const { return network == nullptr; }
    };

    void fill_idle_lanes() {
        for (int l = 0; l < width_; ++l) {
            Lane& lane = lanes_[static_cast<std::size_t>(l)];
            if (!lane.idle()) continue;
            Network const* const network = client_.next(l);
            if (network == nullptr) return;
            reset(l);   // the kernel moves idle lanes too
            lane.network = network;
            lane.steps_left = steps_;
            networks_changed_ = true;
            ++running_;
        }
    }

    /// Idle, at the start.
    void reset(int lane) {
        Lane& now = lanes_[static_cast<std::size_t>(lane)];
        now = Lane{};
        networks_changed_ = true;
        RobotState const robot = start_robot(arena_);
        work_.x[lane] = robot.pose.x;
        work_.y[lane] = robot.pose.y;
        work_.theta[lane] = robot.pose.theta;
        work_.bumper_right[lane] = work_.bumper_left[lane] = 0;
        for (int h = 0; h < most_hidden; ++h) hidden(lane, h) = 0.0f;
        now.world = start_world(arena_);
        write_world(lane);
    }

    float& hidden(int lane, int neuron) { return work_.neurons[(sensor_count + neuron) * width_ + lane]; }

    void lay_networks() {
        std::array<Network const*, most_lanes> networks{};
        for (std::size_t lane = 0; lane < lanes_.size(); ++lane) networks[lane] = lanes_[lane].network;
        layout_.lay({networks.data(), static_cast<std::size_t>(width_)}, width_);
        work_.networks = layout_.view();
        networks_changed_ = false;
    }

    void write_world(int lane) {
        WorldState const& world = lanes_[static_cast<std::size_t>(lane)].world;
        work_.carrying[lane] = world.carrying() ? -1 : 0;
        work_.door_open[lane] = world.door_open ? -1 : 0;
        work_.switch_lit[lane] = world.switch_lit ? -1 : 0;
        work_.balls_mask[lane] = world.balls_mask;
        work_.switch_timer[lane] = world.switch_timer;
    }

    /// Brings the lane's world up to what the kernel keeps of it in lanes.
    void read_world(int lane) {
        WorldState& world = lanes_[static_cast<std::size_t>(lane)].world;
        world.switch_lit = work_.switch_lit[lane] != 0;
        world.switch_timer = static_cast<std::int16_t>(work_.switch_timer[lane]);
    }

    void act_plainly(int lane, float collect) {
        read_world(lane);
        Effectors effectors{};
        effectors[effector_place(Channel::collect)] = collect;
        Lane& now = lanes_[static_cast<std::size_t>(lane)];
        int const before = now.world.collected;
        act(arena_, {work_.x[lane], work_.y[lane], 0.0f}, effectors, now.world);
        int const delivered = now.world.collected - before;
        if (delivered != 0 && work_.step < now.valid)
            rewards_.push_back({lane, work_.step, static_cast<float>(delivered)});
        write_world(lane);
    }

    void run_chunk() {
        for (Lane& lane : lanes_) lane.valid = std::min(lane.steps_left, lane.idle() ? 0 : chunk_steps_);
        std::array<bool, most_lanes> ended{};
        std::array<WorldState, most_lanes> final_worlds;
        rewards_.clear();
        for (int row = 0; row < chunk_steps_;) {
            int to = row < chunk_steps_ - 1 ? chunk_steps_ - 1 : chunk_steps_;   // the last step alone, see below
            for (Lane const& lane : lanes_)
                if (lane.valid > row) to = std::min(to, lane.valid);
            if (stop_when_still_ > 0) to = row + 1;
            bool const judge_rest = to == chunk_steps_ && stop_when_still_ == 0;
            before_ = work_;
            if (judge_rest) hidden_before_.assign(&hidden(0, 0), &hidden(0, work_.networks.hidden_count));
            run_steps_(work_, row, to);
            row = to;
            for (int l = 0; l < width_; ++l) {
                Lane& lane = lanes_[static_cast<std::size_t>(l)];
                if (stop_when_still_ > 0 && lane.valid >= row && stood_still(l)) lane.valid = lane.steps_left = row;
                if (lane.idle() || ended[static_cast<std::size_t>(l)] || lane.valid != row || lane.steps_left != row)
                    continue;
                ended[static_cast<std::size_t>(l)] = true;
                read_world(l);
                final_worlds[static_cast<std::size_t>(l)] = lane.world;
            }
        }

        std::array<int, most_lanes> valid{};
        for (std::size_t l = 0; l < lanes_.size(); ++l) valid[l] = lanes_[l].valid;
        client_.see({width_, chunk_steps_, work_.values, work_.words, work_.trail_x, work_.trail_y, rewards_},
                    {valid.data(), static_cast<std::size_t>(width_)});
        for (int l = 0; l < width_; ++l) {
            Lane& lane = lanes_[static_cast<std::size_t>(l)];
            if (lane.idle()) continue;
            lane.steps_left -= lane.valid;
            if (ended[static_cast<std::size_t>(l)]) {
                end(l, final_worlds[static_cast<std::size_t>(l)]);
            } else if (stop_when_still_ == 0 && at_rest(l)) {
                client_.rest(l, lane.steps_left);
                read_world(l);
                end(l, lane.world);
            } else {
                continue;
            }
            --running_;
            reset(l);
        }
    }

    void end(int lane, WorldState const& world) {
        outcome_.resize(2 * arena_.task.ball_positions.size());
        put_outcome(world, outcome_);
        client_.end(lane, {static_cast<double>(world.collected), outcome_});
    }

    bool stood_still(int l) {
        Pose const was{before_.x[l], before_.y[l], before_.theta[l]}, is{work_.x[l], work_.y[l], work_.theta[l]};
        return is_still(was, is) && ++lanes_[static_cast<std::size_t>(l)].still_steps > stop_when_still_;
    }

    /// True if the last step left everything as it was that steps depend on: pose, bumpers, hidden neurons, world. All
    /// further steps are then the same. (Any event of the rules changes one of the world's values compared here.)
    bool at_rest(int l) const {
        if (work_.x[l] != before_.x[l] || work_.y[l] != before_.y[l] || work_.theta[l] != before_.theta[l])
            return false;
        for (std::size_t i = static_cast<std::size_t>(l); i < hidden_before_.size();
             i += static_cast<std::size_t>(width_))
            if (work_.neurons[static_cast<std::size_t>(sensor_count * width_) + i] != hidden_before_[i]) return false;
        return work_.bumper_right[l] == before_.bumper_right[l] && work_.bumper_left[l] == before_.bumper_left[l] &&
               work_.carrying[l] == before_.carrying[l] && work_.door_open[l] == before_.door_open[l] &&
               work_.balls_mask[l] == before_.balls_mask[l] && work_.switch_lit[l] == before_.switch_lit[l] &&
               work_.switch_timer[l] == before_.switch_timer[l];
    }

    Arena const& arena_;
    int stop_when_still_, steps_, chunk_steps_;
    LaneClient& client_;
    int width_;
    RunSteps run_steps_;
    LaneArenaLayout arena_layout_;
    LaneNetworkLayout layout_;
    int running_ = 0;
    bool networks_changed_ = true;
    std::array<Lane, most_lanes> lanes_;
    LaneWork work_{}, before_{};
    AlignedFloats values_, trail_x_, trail_y_, neurons_, next_hidden_;
    std::vector<std::uint16_t> words_;
    std::vector<LaneReward> rewards_;
    std::vector<float> outcome_;
    std::vector<float> hidden_before_;
};

}   // namespace

void CollectballWorld::run_in_lanes(EpisodeConfig const& config, int chunk_steps, LaneClient& client) const {
    assert(chunk_steps >= 1 && config.steps >= 1);
    LaneRun{arena_, stop_when_still_, config.steps, chunk_steps, client}.run();
}

}   // namespace lore
