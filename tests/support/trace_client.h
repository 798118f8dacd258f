#pragma once

#include <lore/episode/lanes.h>

#include "support/toy_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace lore::test {

inline bool equal(Trace const& a, Trace const& b) {
    return a.channels == b.channels && a.channel_bits == b.channel_bits && a.values == b.values &&
           a.positions == b.positions && a.rewards == b.rewards && a.reward == b.reward && a.outcome == b.outcome;
}

/// Puts traces together from what lanes show.
class TraceClient : public LaneClient {
public:
    TraceClient(World const& world, std::span<Network const> networks)
        : channels_(world.facts()), networks_(networks), traces_(networks.size()), ended_(networks.size()) {
        for (Trace& trace : traces_) trace.channels = channels_;
    }

    Network const* next(int lane) override {
        if (next_ == networks_.size()) return nullptr;
        episodes_[static_cast<std::size_t>(lane)] = next_;
        return &networks_[next_++];
    }
    void see(LaneChunk const& chunk, std::span<int const> valid) override {
        for (int lane = 0; lane < chunk.width; ++lane)
            for (int row = 0; row < valid[static_cast<std::size_t>(lane)]; ++row) add_row(chunk, lane, row);
        for (LaneReward const& reward : chunk.rewards) {
            Trace& trace = trace_of(reward.lane);
            int const first = trace.steps() - valid[static_cast<std::size_t>(reward.lane)];
            trace.rewards.push_back({first + reward.row, reward.amount});
        }
        last_ = chunk;
    }
    void rest(int lane, int steps) override {
        for (int k = 0; k < steps; ++k) add_row(last_, lane, last_.steps - 1);
    }
    void end(int lane, LaneEnd const& end) override {
        trace_of(lane).reward = end.reward;
        trace_of(lane).outcome.assign(end.outcome.begin(), end.outcome.end());
        ended_[episodes_[static_cast<std::size_t>(lane)]] = true;
    }

    std::vector<Trace> const& traces() const { return traces_; }
    bool all_ended() const {
        return std::all_of(ended_.begin(), ended_.end(), [](bool ended) { return ended; });
    }

private:
    Trace& trace_of(int lane) { return traces_[episodes_[static_cast<std::size_t>(lane)]]; }
    void add_row(LaneChunk const& chunk, int lane, int row) {
        Trace& trace = trace_of(lane);
        for (int w = 0; w < channels_.words(); ++w)
            trace.channel_bits.push_back(chunk.words[(row * channels_.words() + w) * chunk.width + lane]);
        for (int c = 0; c < channels_.continuous_count(); ++c)
            trace.values.push_back(chunk.values[(row * channels_.continuous_count() + c) * chunk.width + lane]);
        trace.positions.push_back({chunk.x[row * chunk.width + lane], chunk.y[row * chunk.width + lane]});
    }

    Channels channels_;
    std::span<Network const> networks_;
    std::size_t next_ = 0;
    std::array<std::size_t, most_lanes> episodes_{};
    std::vector<Trace> traces_;
    std::vector<bool> ended_;
    LaneChunk last_;
};

using Way = void (*)(World const&, EpisodeConfig const&, int, LaneClient&);

inline void expect_equal_to_plain_episodes(World const& world, int episodes, EpisodeConfig const& config,
                                           int chunk_steps, Way run) {
    std::vector<Network> networks;
    for (int i = 0; i < episodes; ++i)
        networks.push_back(compile(random_genome(world, 31, static_cast<std::uint32_t>(i))));
    TraceClient client{world, networks};
    run(world, config, chunk_steps, client);
    EXPECT_TRUE(client.all_ended());
    for (std::size_t i = 0; i < networks.size(); ++i)
        ASSERT_TRUE(equal(client.traces()[i], record_episode(world, networks[i], config))) << "episode " << i;
}

}   // namespace lore::test
