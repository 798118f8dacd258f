#include <lore/collectball/collectball.h>

#include <lore/core/isa.h>
#include <lore/episode/lane_run.h>

#include "lane_arena.h"
#include "lane_work.h"

#include <algorithm>
#include <array>
#include <optional>

namespace lore {

namespace {

static_assert(lane_slots == most_lanes);

using RunSteps = int (*)(LaneWork&, int first, int last);

/// Robots side by side in one arena. What happens seldom, the rules decide a lane at a time, as in the plain episode.
class ArenaLives final : public LaneLives {
public:
    ArenaLives(Arena const& arena, int stop_when_still)
        : arena_(arena), width_(lane_count()), run_steps_(kernel_for(active_isa(), LORE_KERNELS(run_steps))),
          arena_layout_(arena) {
        work_.arena = arena_layout_.view();
        work_.stop_when_still = stop_when_still;
        work_.owner = this;
        work_.act = [](LaneWork& work, int lane, float collect) {
            static_cast<ArenaLives*>(work.owner)->act_plainly(lane, collect);
        };
    }

    void begin(int lane) override {
        Lane& now = at(lane);
        now = Lane{};
        RobotState const robot = start_robot(arena_);
        work_.x[lane] = robot.pose.x;
        work_.y[lane] = robot.pose.y;
        work_.theta[lane] = robot.pose.theta;
        work_.bumper_right[lane] = work_.bumper_left[lane] = 0;
        work_.still_steps[lane] = 0;
        now.world = start_world(arena_);
        write_world(lane);
    }

    void run(LaneBuffers const& buffers, int rows, std::span<LaneProgress> progress,
             std::vector<LaneReward>& rewards) override {
        work_.buffers = buffers;
        progress_ = progress;
        rewards_ = &rewards;
        for (int row = 0; row < rows;) {
            int to = row < rows - 1 ? rows - 1 : rows;   // the last step alone, see `rests`
            for (LaneProgress const& lane : progress)
                if (lane.rows > row) to = std::min(to, lane.rows);
            if (to == rows) {
                before_ = work_;
                hidden_before_.assign(hidden(), hidden() + buffers.networks.hidden_count * width_);
            }
            row = run_steps_(work_, row, to);
            for (int l = 0; l < width_; ++l) {
                LaneProgress& lane = progress[static_cast<std::size_t>(l)];
                if (stood_still(l) && lane.rows >= row) lane = {row, true};
                if (lane.rows == row && row < rows) at(l).last = at(l).world;
            }
        }
    }

    /// Pose, bumpers, hidden neurons and world are compared. (Any event of the rules changes one of the world's values
    /// that are compared here.)
    bool rests(int l) const override {
        if (work_.stop_when_still > 0) return false;
        if (work_.x[l] != before_.x[l] || work_.y[l] != before_.y[l] || work_.theta[l] != before_.theta[l])
            return false;
        for (std::size_t i = static_cast<std::size_t>(l); i < hidden_before_.size();
             i += static_cast<std::size_t>(width_))
            if (hidden()[i] != hidden_before_[i]) return false;
        return work_.bumper_right[l] == before_.bumper_right[l] && work_.bumper_left[l] == before_.bumper_left[l] &&
               work_.carrying[l] == before_.carrying[l] && work_.door_open[l] == before_.door_open[l] &&
               work_.balls_mask[l] == before_.balls_mask[l] && work_.switch_lit[l] == before_.switch_lit[l] &&
               work_.switch_timer[l] == before_.switch_timer[l];
    }

    void outcome(int lane, std::span<float> values) const override {
        Lane const& now = lanes_[static_cast<std::size_t>(lane)];
        put_outcome(now.last ? *now.last : now.world, values);
    }

private:
    struct Lane {
        WorldState world;
        std::optional<WorldState> last;   ///< after the last row of a life that ends before its chunk
    };

    Lane& at(int lane) { return lanes_[static_cast<std::size_t>(lane)]; }
    float const* hidden() const { return work_.buffers.neurons + sensor_count * width_; }

    void write_world(int lane) {
        WorldState const& world = at(lane).world;
        work_.carrying[lane] = world.carrying() ? -1 : 0;
        work_.door_open[lane] = world.door_open ? -1 : 0;
        work_.switch_lit[lane] = world.switch_lit ? -1 : 0;
        work_.balls_mask[lane] = world.balls_mask;
        work_.switch_timer[lane] = world.switch_timer;
    }

    /// Brings the lane's world up to what the kernel keeps of it in lanes.
    void read_world(int lane) {
        WorldState& world = at(lane).world;
        world.switch_lit = work_.switch_lit[lane] != 0;
        world.switch_timer = static_cast<std::int16_t>(work_.switch_timer[lane]);
    }

    void act_plainly(int lane, float collect) {
        read_world(lane);
        Effectors effectors{};
        effectors[effector_place(Channel::collect)] = collect;
        WorldState& world = at(lane).world;
        int const before = world.collected;
        act(arena_, {work_.x[lane], work_.y[lane], 0.0f}, effectors, world);
        int const delivered = world.collected - before;
        if (delivered != 0 && work_.step < progress_[static_cast<std::size_t>(lane)].rows)
            rewards_->push_back({lane, work_.step, static_cast<float>(delivered)});
        write_world(lane);
    }

    bool stood_still(int l) const { return work_.stop_when_still > 0 && work_.still_steps[l] > work_.stop_when_still; }

    Arena const& arena_;
    int width_;
    RunSteps run_steps_;
    LaneArenaLayout arena_layout_;
    std::array<Lane, most_lanes> lanes_;
    LaneWork work_{}, before_{};   ///< now, and before the last row
    std::vector<float> hidden_before_;
    std::span<LaneProgress> progress_;   ///< of the chunk that is run
    std::vector<LaneReward>* rewards_ = nullptr;
};

}   // namespace

void CollectballWorld::run_in_lanes(EpisodeConfig const& config, int chunk_steps, LaneClient& client) const {
    ArenaLives lives{arena_, stop_when_still_};
    run_lives(lives, facts_, config, chunk_steps, client);
}

}   // namespace lore
