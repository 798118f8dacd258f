#include <lore/episode/rules_world.h>

namespace lore {

RulesLives::RulesLives(void const* rules, Kernel* kernel, std::span<float const> start)
    : rules_(rules), kernel_(kernel), width_(lane_count()), start_(start.begin(), start.end()) {
    states_.assign_zeros(start.size() * static_cast<std::size_t>(width_));
}

void RulesLives::begin(int lane) {
    for (std::size_t m = 0; m < start_.size(); ++m)
        states_[m * static_cast<std::size_t>(width_) + static_cast<std::size_t>(lane)] = start_[m];
}

void RulesLives::run(LaneBuffers const& buffers, int rows, std::span<LaneProgress> progress,
                     std::vector<LaneReward>& rewards) {
    auto const columns = static_cast<std::size_t>(width_), values = static_cast<std::size_t>(rows) * columns;
    if (rewards_.size() < values) rewards_.assign_zeros(values);
    for (std::size_t lane = 0; lane < columns; ++lane) rows_[lane] = progress[lane].rows;
    over_.fill(0);
    kernel_({rules_, rows, states_.data(), rows_.data(), over_.data(), rewards_.data(), buffers});
    for (std::size_t lane = 0; lane < columns; ++lane) progress[lane] = {rows_[lane], over_[lane] != 0};
    int const running = width_ / lane_vectors * buffers.vectors;
    for (int row = 0; row < rows; ++row)
        for (int lane = 0; lane < running; ++lane)
            if (float const amount = rewards_[static_cast<std::size_t>(row * width_ + lane)]; amount != 0)
                rewards.push_back({lane, row, amount});
}

void RulesLives::put_state(int lane, std::span<float> members) const {
    for (std::size_t m = 0; m < members.size(); ++m)
        members[m] = states_.data()[m * static_cast<std::size_t>(width_) + static_cast<std::size_t>(lane)];
}

}   // namespace lore
