#include <lore/episode/lanes.h>

#include <lore/core/isa.h>
#include <lore/episode/lane_networks.h>

#include "batch_kernel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

namespace lore {

namespace {

/// A batch of lives after another, each life in a lane of its own.
class BatchRun {
public:
    BatchRun(World const& world, EpisodeConfig const& config, int chunk_steps, LaneClient& client)
        : world_(world), channels_(world.facts()), steps_(config.steps), chunk_steps_(chunk_steps), client_(client),
          width_(lane_count()), kernel_(kernel_for(active_isa(), LORE_KERNELS(batch))()),
          continuous_(static_cast<std::size_t>(channels_.continuous_count())),
          words_a_step_(static_cast<std::size_t>(channels_.words())) {
        auto const columns = static_cast<std::size_t>(width_), rows = static_cast<std::size_t>(chunk_steps);
        auto const sensors = static_cast<std::size_t>(channels_.sensors());
        neurons_.assign_zeros((sensors + most_hidden) * columns);
        next_hidden_.assign_zeros(most_hidden * columns);
        outputs_.assign_zeros(static_cast<std::size_t>(channels_.effectors()) * columns);
        values_.assign_zeros(rows * continuous_ * columns);
        x_.assign_zeros(rows * columns);
        y_.assign_zeros(rows * columns);
        words_.resize(rows * words_a_step_ * columns);
    }

    void run() {
        int const most = std::min(width_, world_.facts().max_batch);
        while (true) {
            networks_.clear();
            for (int lane = 0; lane < most; ++lane) {
                Network const* const network = client_.next(lane);
                if (network == nullptr) break;
                networks_.push_back(network);
            }
            if (networks_.empty()) return;
            begin();
            while (left_ > 0) run_chunk();
        }
    }

private:
    /// A life for every network.
    void begin() {
        count_ = networks_.size();
        left_ = static_cast<int>(count_);
        done_ = 0;
        lives_ = world_.begin_lives(left_);
        layout_.lay(networks_, width_);
        std::fill_n(neurons_.data(), neurons_.size(), 0.0f);
        sensed_.assign(static_cast<std::size_t>(channels_.sensors()) * count_, 0);
        acted_.assign(static_cast<std::size_t>(channels_.effectors()) * count_, 0);
        positions_.assign(2 * count_, 0);
        rewards_.assign(count_, 0);
        over_.assign(count_, 0);
        totals_.assign(count_, 0);
        lengths_.assign(count_, steps_);
    }

    void run_chunk() {
        chunk_rewards_.clear();
        int const rows = std::min(chunk_steps_, steps_ - done_);
        int row = 0;
        for (; row < rows && left_running() > 0; ++row) run_step(static_cast<std::size_t>(row));

        std::array<int, most_lanes> valid{};
        for (std::size_t lane = 0; lane < count_; ++lane) valid[lane] = std::clamp(lengths_[lane] - done_, 0, row);
        client_.see({width_, row, values_.data(), words_.data(), x_.data(), y_.data(), chunk_rewards_},
                    {valid.data(), static_cast<std::size_t>(width_)});
        int const before = done_;
        done_ += row;
        if (std::none_of(lengths_.begin(), lengths_.end(),
                         [&](int length) { return length > before && length <= done_; }))
            return;
        auto const size = static_cast<std::size_t>(world_.facts().outcome_size);
        outcomes_.resize(size * count_);
        outcome_.resize(size);
        lives_->outcome(outcomes_);
        for (std::size_t lane = 0; lane < count_; ++lane) {
            if (lengths_[lane] <= before || lengths_[lane] > done_) continue;
            for (std::size_t i = 0; i < size; ++i) outcome_[i] = outcomes_[i * count_ + lane];
            client_.end(static_cast<int>(lane), {totals_[lane], outcome_});
            --left_;
        }
    }

    int left_running() const {
        return static_cast<int>(std::count(over_.begin(), over_.end(), static_cast<unsigned char>(0)));
    }

    void run_step(std::size_t row) {
        auto const columns = static_cast<std::size_t>(width_);
        lives_->sense(sensed_, std::span{positions_}.first(count_), std::span{positions_}.subspan(count_));
        spread(sensed_, channels_.sensors(), neurons_.data());
        std::copy_n(positions_.begin(), count_, x_.data() + row * columns);
        std::copy_n(positions_.begin() + static_cast<std::ptrdiff_t>(count_), count_, y_.data() + row * columns);
        int const vectors = count_ <= columns / lane_vectors ? 1 : lane_vectors;
        kernel_.tick(layout_.view(), vectors, channels_.sensors(), channels_.effectors(),
                     {neurons_.data(), next_hidden_.data()}, outputs_.data());
        round_outputs();
        record(row);
        for (std::size_t e = 0; e < static_cast<std::size_t>(channels_.effectors()); ++e)
            std::copy_n(outputs_.data() + e * columns, count_,
                        acted_.begin() + static_cast<std::ptrdiff_t>(e * count_));
        before_ = over_;
        lives_->act(acted_, rewards_, over_);
        for (std::size_t lane = 0; lane < count_; ++lane) {
            if (before_[lane] != 0) continue;
            totals_[lane] += static_cast<double>(rewards_[lane]);
            if (rewards_[lane] != 0)
                chunk_rewards_.push_back({static_cast<int>(lane), static_cast<int>(row), rewards_[lane]});
            if (over_[lane] != 0) lengths_[lane] = done_ + static_cast<int>(row) + 1;
        }
    }

    /// Rows of `count_` values become rows of lanes.
    void spread(std::span<float const> from, int rows, float* to) const {
        for (std::size_t r = 0; r < static_cast<std::size_t>(rows); ++r)
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(r * count_), count_,
                        to + r * static_cast<std::size_t>(width_));
    }

    void round_outputs() {
        auto const columns = static_cast<std::size_t>(width_);
        for (int e = 0; e < channels_.effectors(); ++e) {
            if (!channels_.is_binary(channels_.sensors() + e)) continue;
            float* const output = outputs_.data() + static_cast<std::size_t>(e) * columns;
            for (std::size_t lane = 0; lane < columns; ++lane) output[lane] = output[lane] > 0.5f ? 1.0f : 0.0f;
        }
    }

    /// A row of the chunk: what put_channel_bits says, for all lanes.
    void record(std::size_t row) {
        auto const columns = static_cast<std::size_t>(width_);
        std::uint16_t* const words = words_.data() + row * words_a_step_ * columns;
        std::fill_n(words, words_a_step_ * columns, std::uint16_t{0});
        std::size_t bit = 0;
        auto const put = [&](int channel) {
            float const* const values = row_of(channel);
            std::uint16_t* const to = words + bit / 16 * columns;
            for (std::size_t lane = 0; lane < columns; ++lane)
                to[lane] = static_cast<std::uint16_t>(to[lane] | unsigned{values[lane] > 0.5f} << bit % 16);
            ++bit;
        };
        for (int const channel : channels_.binary()) put(channel);
        float* to = values_.data() + row * continuous_ * columns;
        for (int const channel : channels_.continuous()) {
            put(channel);
            to = std::copy_n(row_of(channel), columns, to);
        }
    }

    float const* row_of(int channel) const {
        auto const columns = static_cast<std::size_t>(width_);
        return channel < channels_.sensors()
                   ? neurons_.data() + static_cast<std::size_t>(channel) * columns
                   : outputs_.data() + static_cast<std::size_t>(channel - channels_.sensors()) * columns;
    }

    World const& world_;
    Channels channels_;
    int steps_, chunk_steps_;
    LaneClient& client_;
    int width_;
    BatchKernel kernel_;
    std::size_t continuous_, words_a_step_;
    AlignedFloats neurons_, next_hidden_, outputs_, values_, x_, y_;   ///< rows of lanes
    std::vector<std::uint16_t> words_;
    LaneNetworkLayout layout_;

    // Of the batch under way; rows of `count_` values, as Lives has them.
    std::vector<Network const*> networks_;
    std::unique_ptr<Lives> lives_;
    std::size_t count_ = 0;
    int done_ = 0;   ///< steps
    int left_ = 0;   ///< lives that have not been told to have ended
    std::vector<float> sensed_, acted_, positions_, rewards_, outcomes_, outcome_;
    std::vector<unsigned char> over_, before_;
    std::vector<double> totals_;
    std::vector<int> lengths_;   ///< steps of each life, as far as they are known
    std::vector<LaneReward> chunk_rewards_;
};

}   // namespace

int lane_count() { return lane_vectors * lanes_of(active_isa()); }

void run_in_batches(World const& world, EpisodeConfig const& config, int chunk_steps, LaneClient& client) {
    assert(chunk_steps >= 1 && config.steps >= 1);
    BatchRun{world, config, chunk_steps, client}.run();
}

void run_in_lanes(World const& world, EpisodeConfig const& config, int chunk_steps, LaneClient& client) {
    if (auto const* const in_lanes = dynamic_cast<LaneWorld const*>(&world))
        in_lanes->run_in_lanes(config, chunk_steps, client);
    else run_in_batches(world, config, chunk_steps, client);
}

std::vector<int> largest_first(std::span<Network const> networks) {
    std::vector<int> order(networks.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        Network const &m = networks[static_cast<std::size_t>(a)], &n = networks[static_cast<std::size_t>(b)];
        return m.hidden_count != n.hidden_count ? m.hidden_count > n.hidden_count : m.edge_count() > n.edge_count();
    });
    return order;
}

}   // namespace lore
