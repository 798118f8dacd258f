#include <lore/episode/lane_run.h>

#include <lore/episode/aligned_floats.h>
#include <lore/episode/lane_networks.h>

#include <algorithm>
#include <array>
#include <cassert>

namespace lore {

namespace {

/// The lanes, each filled by the client whenever it is idle.
class LaneRun {
public:
    LaneRun(LaneLives& lives, WorldFacts const& facts, int steps, int chunk_steps, LaneClient& client)
        : lives_(lives), steps_(steps), chunk_steps_(chunk_steps), client_(client), width_(lane_count()),
          sensors_(static_cast<int>(facts.sensors.size())), outcome_(static_cast<std::size_t>(facts.outcome_size)) {
        Channels const channels{facts};
        auto const columns = static_cast<std::size_t>(width_), rows = static_cast<std::size_t>(chunk_steps);
        neurons_.assign_zeros(static_cast<std::size_t>(sensors_ + most_hidden) * columns);
        next_hidden_.assign_zeros(most_hidden * columns);
        values_.assign_zeros(rows * static_cast<std::size_t>(channels.continuous_count()) * columns);
        words_.resize(rows * static_cast<std::size_t>(channels.words()) * columns + most_lanes);
        x_.assign_zeros(rows * columns);
        y_.assign_zeros(rows * columns);
    }

    void run() {
        for (int lane = 0; lane < width_; ++lane) reset(lane);
        while (true) {
            fill_idle_lanes();
            if (running_ == 0) return;
            if (networks_changed_) lay_networks();
            run_chunk();
        }
    }

private:
    struct Lane {
        Network const* network = nullptr;   ///< null: idle
        int steps_left = 0;
        double reward = 0;
        bool idle() const { return network == nullptr; }
    };

    Lane& at(int lane) { return lanes_[static_cast<std::size_t>(lane)]; }

    void fill_idle_lanes() {
        for (int l = 0; l < width_; ++l) {
            if (!at(l).idle()) continue;
            Network const* const network = client_.next(l);
            if (network == nullptr) return;
            reset(l);   // the kernel steps idle lanes too
            at(l).network = network;
            at(l).steps_left = steps_;
            ++running_;
        }
    }

    /// Idle, at the start.
    void reset(int lane) {
        at(lane) = Lane{};
        networks_changed_ = true;
        lives_.begin(lane);
        for (int h = 0; h < most_hidden; ++h) neurons_[static_cast<std::size_t>((sensors_ + h) * width_ + lane)] = 0.0f;
    }

    void lay_networks() {
        std::array<Network const*, most_lanes> networks{};
        for (std::size_t lane = 0; lane < lanes_.size(); ++lane) networks[lane] = lanes_[lane].network;
        layout_.lay({networks.data(), static_cast<std::size_t>(width_)}, width_);
        networks_changed_ = false;
    }

    void run_chunk() {
        std::array<LaneProgress, most_lanes> progress{};
        int rows = 0;
        for (std::size_t l = 0; l < lanes_.size(); ++l) {
            progress[l].rows = lanes_[l].idle() ? 0 : std::min(lanes_[l].steps_left, chunk_steps_);
            rows = std::max(rows, progress[l].rows);
        }
        auto const idle = [](Lane const& lane) { return lane.idle(); };
        bool const one_is_enough = std::all_of(lanes_.begin() + width_ / lane_vectors, lanes_.end(), idle);
        rewards_.clear();
        lives_.run({layout_.view(), one_is_enough ? 1 : lane_vectors, neurons_.data(), next_hidden_.data(),
                    values_.data(), words_.data(), x_.data(), y_.data()},
                   rows, {progress.data(), static_cast<std::size_t>(width_)}, rewards_);

        std::array<int, most_lanes> valid{};
        for (std::size_t l = 0; l < lanes_.size(); ++l) valid[l] = progress[l].rows;
        client_.see({width_, rows, values_.data(), words_.data(), x_.data(), y_.data(), rewards_},
                    {valid.data(), static_cast<std::size_t>(width_)});
        for (LaneReward const& reward : rewards_) at(reward.lane).reward += static_cast<double>(reward.amount);
        for (int l = 0; l < width_; ++l)
            if (!at(l).idle()) go_on(l, progress[static_cast<std::size_t>(l)]);
    }

    void go_on(int l, LaneProgress const& progress) {
        Lane& lane = at(l);
        lane.steps_left -= progress.rows;
        if (!progress.over && lane.steps_left > 0) {
            if (!lives_.rests(l)) return;
            client_.rest(l, lane.steps_left);
        }
        lives_.outcome(l, outcome_);
        client_.end(l, {lane.reward, outcome_});
        --running_;
        reset(l);
    }

    LaneLives& lives_;
    int steps_, chunk_steps_;
    LaneClient& client_;
    int width_, sensors_;
    int running_ = 0;
    bool networks_changed_ = true;
    std::array<Lane, most_lanes> lanes_;
    LaneNetworkLayout layout_;
    AlignedFloats neurons_, next_hidden_, values_, x_, y_;
    std::vector<std::uint16_t> words_;
    std::vector<LaneReward> rewards_;
    std::vector<float> outcome_;
};

}   // namespace

void run_lives(LaneLives& lives, WorldFacts const& facts, EpisodeConfig const& config, int chunk_steps,
               LaneClient& client) {
    assert(chunk_steps >= 1 && config.steps >= 1);
    LaneRun{lives, facts, config.steps, chunk_steps, client}.run();
}

}   // namespace lore
