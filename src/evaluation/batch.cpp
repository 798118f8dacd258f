#include <lore/evaluation/evaluation_queue.h>

#include <lore/episode/lanes.h>

#include "chunk_kernel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

namespace lore {

namespace {

static_assert(tally_bins == entropy_bins && tally_lanes == most_lanes);

/// A chunk's buffers should stay in the inner caches: 40 steps of 32 lanes are 43 kB.
constexpr int usual_chunk_steps = 40;

/// Fills the lanes from a queue and turns what they do into Evaluations, chunk by chunk.
class Recorder : public LaneClient {
public:
    Recorder(EvaluationContext const& context, EvaluationQueue& queue)
        : context_(context), queue_(queue), kernel_(kernel_for(active_isa(), LORE_KERNELS(chunk))()) {
        if (context.shaper) {
            window_length_ = context.shaper->base().config().window_length;
            reader_.emplace(context.shaper->reader());
            window_values_.resize(static_cast<std::size_t>(window_length_ * continuous_count));
        }
    }

    /// Whole windows, where there is a knowledge base.
    int chunk_steps() const {
        return window_length_ == 0 ? usual_chunk_steps
                                   : window_length_ * std::max(1, usual_chunk_steps / window_length_);
    }

    Network const* next(int lane) override {
        auto const item = queue_.next();
        if (!item) return nullptr;
        Lane& now = at(lane);
        now.ticket = item->ticket;
        now.network = compile(*item->genome);
        now.steps = 0;
        now.shaping = {};
        std::size_t const steps = static_cast<std::size_t>(context_.episode.steps);
        // Room for a chunk more, so that whole chunks can be written.
        now.bits.resize(steps + static_cast<std::size_t>(chunk_steps()));
        now.path.clear();
        for (auto& channel : tally_.counts)
            for (auto& bin : channel) bin[lane] = 0;
        return &now.network;
    }

    void see(LaneChunk const& chunk, std::span<int const> valid) override {
        kernel_.tally(chunk.values, chunk.steps, chunk.width, tally_);
        std::array<std::uint16_t*, most_lanes> places{};
        idle_.resize(static_cast<std::size_t>(chunk.steps));
        for (int lane = 0; lane < chunk.width; ++lane)
            places[static_cast<std::size_t>(lane)] =
                valid[static_cast<std::size_t>(lane)] > 0 ? at(lane).bits.data() + at(lane).steps : idle_.data();
        kernel_.transpose_words(chunk.words, chunk.steps, chunk.width, places.data());
        for (int lane = 0; lane < chunk.width; ++lane) {
            int const rows = valid[static_cast<std::size_t>(lane)];
            if (rows == 0) continue;
            Lane& now = at(lane);
            for (int row = rows; row < chunk.steps; ++row)
                count_row(chunk, lane, row, ~0u);   // not the episode's: take back
            for (int row = (steps_per_tile_sample - now.steps % steps_per_tile_sample) % steps_per_tile_sample;
                 row < rows; row += steps_per_tile_sample)
                now.path.push_back(
                    tile_of(context_.arena, chunk.x[row * chunk.width + lane], chunk.y[row * chunk.width + lane]));
            if (reader_)
                for (int row = 0; row + window_length_ <= rows; row += window_length_)
                    show_window(chunk, lane, now.steps + row, row, 1);
            now.steps += rows;
        }
        last_ = chunk;
        queue_.pulse();
    }

    void rest(int lane, int steps) override {
        Lane& now = at(lane);
        int const row = last_.steps - 1;
        for (int k = 0; k < steps; ++k)
            now.bits[static_cast<std::size_t>(now.steps + k)] = last_.words[row * last_.width + lane];
        count_row(last_, lane, row, static_cast<std::uint32_t>(steps));
        int const first =
            now.steps + (steps_per_tile_sample - now.steps % steps_per_tile_sample) % steps_per_tile_sample;
        Tile const tile = tile_of(context_.arena, last_.x[row * last_.width + lane], last_.y[row * last_.width + lane]);
        for (int step = first; step < now.steps + steps; step += steps_per_tile_sample) now.path.push_back(tile);
        // Every window of a robot at rest shows the same row throughout.
        if (reader_ && steps >= window_length_) show_window(last_, lane, now.steps, row, 0, steps / window_length_);
        now.steps += steps;
    }

    void end(int lane, WorldState const& world) override {
        Lane& now = at(lane);
        Evaluation e;
        e.balls = world.collected;
        if (reader_) {
            e.shaping = reader_->value(now.shaping);
            if (context_.shaper->rule() == ShapingRule::share) e.shown = now.shaping.shown;
        }
        Descriptors& d = e.descriptors;
        d.ball_positions.assign(world.released.begin(),
                                world.released.begin() +
                                    static_cast<std::ptrdiff_t>(context_.arena.task.ball_positions.size()));
        d.channel_bits.assign(now.bits.begin(), now.bits.begin() + now.steps);
        d.path = now.path;
        ChannelHistograms histograms;
        for (int c = 0; c < continuous_count; ++c)
            for (int bin = 0; bin < entropy_bins; ++bin)
                histograms.continuous[static_cast<std::size_t>(c)][static_cast<std::size_t>(bin)] =
                    tally_.counts[c][bin][lane];
        std::uint32_t ones[binary_count];
        kernel_.count_ones(d.channel_bits.data(), now.steps, ones);
        std::copy_n(ones, binary_count, histograms.ones.begin());
        d.entropies = entropies(histograms, now.steps);
        queue_.deliver(now.ticket, std::move(e));
    }

private:
    struct Lane {
        int ticket = 0;
        Network network;
        int steps = 0;
        std::vector<std::uint16_t> bits;
        std::vector<Tile> path;
        ShapingState shaping;
    };

    Lane& at(int lane) { return lanes_[static_cast<std::size_t>(lane)]; }

    void count_row(LaneChunk const& chunk, int lane, int row, std::uint32_t times) {
        for (int c = 0; c < continuous_count; ++c)
            tally_.counts[c][entropy_bin(chunk.values[(row * continuous_count + c) * chunk.width + lane])][lane] +=
                times;
    }

    /// The window that begins at step `start` of the lane's robot: its values are in the chunk's rows first_row,
    /// first_row + stride and so on. They are only fetched if its bits leave anything to gain (by rule max, one time in
    /// four). `times`: so many windows in a row are equal to it.
    void show_window(LaneChunk const& chunk, int lane, int start, int first_row, int stride, int times = 1) {
        Lane& now = at(lane);
        std::span<std::uint16_t const> const bits{now.bits.data() + start, static_cast<std::size_t>(window_length_)};
        if (!reader_->may_matter(bits, now.shaping)) return;
        float* to = window_values_.data();
        for (int step = 0; step < window_length_; ++step)
            for (int c = 0; c < continuous_count; ++c)
                *to++ = chunk.values[((first_row + step * stride) * continuous_count + c) * chunk.width + lane];
        reader_->see({bits, window_values_}, now.shaping, times);
    }

    EvaluationContext const& context_;
    EvaluationQueue& queue_;
    ChunkKernel kernel_;
    int window_length_ = 0;
    std::optional<Shaper::Reader> reader_;
    std::array<Lane, most_lanes> lanes_;
    LaneTally tally_{};
    LaneChunk last_;                     ///< rest() reads the row that was seen last
    std::vector<float> window_values_;   ///< [step][continuous_count], of the window that is asked for
    std::vector<std::uint16_t> idle_;    ///< where words of idle lanes go
};

/// A request that this rank evaluates alone.
class WholeRequest : public EvaluationQueue {
public:
    explicit WholeRequest(Request& request) : request_(request) {}
    std::optional<Item> next() override {
        if (request_.left() == 0) return std::nullopt;
        int const ticket = request_.next_ticket();
        request_.hand_out(1);
        return Item{ticket, &request_.genome(ticket)};
    }
    void deliver(int ticket, Evaluation evaluation) override { request_.deliver(ticket, std::move(evaluation)); }

private:
    Request& request_;
};

}   // namespace

void evaluate_queue(EvaluationContext const& context, EvaluationQueue& queue) {
    Recorder recorder{context, queue};
    run_in_lanes(context.arena, context.episode, recorder.chunk_steps(), recorder);
}

std::vector<Evaluation> evaluate_batch(EvaluationContext const& context, std::span<Genome const* const> genomes) {
    Request request{genomes};
    WholeRequest queue{request};
    evaluate_queue(context, queue);
    return std::move(request).results();
}

}   // namespace lore
