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

/// A chunk's buffers should stay in the inner caches: 40 steps of 32 lanes are 43 kB for the channels of the paper.
constexpr int usual_chunk_steps = 40;

/// Fills the lanes from a queue and turns what they do into Evaluations, chunk by chunk.
class Recorder : public LaneClient {
public:
    Recorder(EvaluationContext const& context, EvaluationQueue& queue)
        : context_(context), queue_(queue), facts_(context.world->facts()), channels_(facts_),
          continuous_(channels_.continuous_count()), words_(channels_.words()),
          kernel_(kernel_for(active_isa(), LORE_KERNELS(chunk))()), tallies_(static_cast<std::size_t>(continuous_)) {
        if (context.shaper) {
            assert(context.shaper->base().config().channels == channels_);
            window_length_ = context.shaper->base().config().window_length;
            reader_.emplace(context.shaper->reader());
            window_values_.resize(static_cast<std::size_t>(window_length_ * continuous_));
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
        now.bits.resize((steps + static_cast<std::size_t>(chunk_steps())) * static_cast<std::size_t>(words_));
        now.path.clear();
        for (LaneTally& tally : tallies_)
            for (auto& bin : tally.counts) bin[lane] = 0;
        return &now.network;
    }

    void see(LaneChunk const& chunk, std::span<int const> valid) override {
        kernel_.tally(chunk.values, chunk.steps, continuous_, chunk.width, tallies_.data());
        std::array<std::uint16_t*, most_lanes> places{};
        idle_.resize(static_cast<std::size_t>(chunk.steps * words_));
        for (int lane = 0; lane < chunk.width; ++lane)
            places[static_cast<std::size_t>(lane)] =
                valid[static_cast<std::size_t>(lane)] > 0 ? bits_at(lane, at(lane).steps) : idle_.data();
        kernel_.transpose_words(chunk.words, chunk.steps * words_, chunk.width, places.data());
        for (int lane = 0; lane < chunk.width; ++lane) {
            int const rows = valid[static_cast<std::size_t>(lane)];
            if (rows == 0) continue;
            Lane& now = at(lane);
            for (int row = rows; row < chunk.steps; ++row)
                count_row(chunk, lane, row, ~0u);   // not the episode's: take back
            for (int row = (steps_per_tile_sample - now.steps % steps_per_tile_sample) % steps_per_tile_sample;
                 row < rows; row += steps_per_tile_sample)
                now.path.push_back(
                    tile_of(facts_, chunk.x[row * chunk.width + lane], chunk.y[row * chunk.width + lane]));
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
        std::uint16_t* to = bits_at(lane, now.steps);
        for (int k = 0; k < steps; ++k)
            for (int word = 0; word < words_; ++word) *to++ = last_.words[(row * words_ + word) * last_.width + lane];
        count_row(last_, lane, row, static_cast<std::uint32_t>(steps));
        int const first =
            now.steps + (steps_per_tile_sample - now.steps % steps_per_tile_sample) % steps_per_tile_sample;
        Tile const tile = tile_of(facts_, last_.x[row * last_.width + lane], last_.y[row * last_.width + lane]);
        for (int step = first; step < now.steps + steps; step += steps_per_tile_sample) now.path.push_back(tile);
        // Every window of an episode at rest shows the same row throughout.
        if (reader_ && steps >= window_length_) show_window(last_, lane, now.steps, row, 0, steps / window_length_);
        now.steps += steps;
    }

    void end(int lane, LaneEnd const& how) override {
        Lane& now = at(lane);
        Evaluation e;
        e.reward = how.reward;
        if (reader_) {
            e.shaping = reader_->value(now.shaping);
            if (context_.shaper->rule() == ShapingRule::share) e.shown = now.shaping.shown;
        }
        Descriptors& d = e.descriptors;
        d.outcome.assign(how.outcome.begin(), how.outcome.end());
        d.channel_bits.assign(bits_at(lane, 0), bits_at(lane, now.steps));
        d.path = now.path;
        d.entropies = entropies(channels_, histograms_of(lane), now.steps);
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
    /// Of that step, [step][word].
    std::uint16_t* bits_at(int lane, int step) { return at(lane).bits.data() + step * words_; }

    void count_row(LaneChunk const& chunk, int lane, int row, std::uint32_t times) {
        for (int c = 0; c < continuous_; ++c) {
            float const value = chunk.values[(row * continuous_ + c) * chunk.width + lane];
            tallies_[static_cast<std::size_t>(c)].counts[entropy_bin(value)][lane] += times;
        }
    }

    /// Of the lane's whole episode.
    ChannelHistograms histograms_of(int lane) {
        ChannelHistograms histograms{channels_};
        for (std::size_t c = 0; c < tallies_.size(); ++c)
            for (int bin = 0; bin < entropy_bins; ++bin)
                histograms.continuous[c][static_cast<std::size_t>(bin)] = tallies_[c].counts[bin][lane];
        for (int first = 0; first < channels_.binary_count(); first += 16)
            kernel_.count_ones(bits_at(lane, 0) + first / 16, at(lane).steps, words_,
                               std::min(channels_.binary_count() - first, 16), histograms.ones.data() + first);
        return histograms;
    }

    /// The window that begins at step `start` of the lane's episode: its values are in the chunk's rows first_row,
    /// first_row + stride and so on. They are only fetched if its bits leave anything to gain (by rule max, one time in
    /// four). `times`: so many windows in a row are equal to it.
    void show_window(LaneChunk const& chunk, int lane, int start, int first_row, int stride, int times = 1) {
        Lane& now = at(lane);
        std::span<std::uint16_t const> const bits{bits_at(lane, start),
                                                  static_cast<std::size_t>(window_length_ * words_)};
        if (!reader_->may_matter(bits, now.shaping)) return;
        float* to = window_values_.data();
        for (int step = 0; step < window_length_; ++step)
            for (int c = 0; c < continuous_; ++c)
                *to++ = chunk.values[((first_row + step * stride) * continuous_ + c) * chunk.width + lane];
        reader_->see({bits, window_values_}, now.shaping, times);
    }

    EvaluationContext const& context_;
    EvaluationQueue& queue_;
    WorldFacts const& facts_;
    Channels channels_;
    int continuous_, words_;   ///< continuous channels, and words a step
    ChunkKernel kernel_;
    int window_length_ = 0;
    std::optional<Shaper::Reader> reader_;
    std::array<Lane, most_lanes> lanes_;
    std::vector<LaneTally> tallies_;     ///< [continuous channel]
    LaneChunk last_;                     ///< rest() reads the row that was seen last
    std::vector<float> window_values_;   ///< [step][continuous channel], of the window that is asked for
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
    run_in_lanes(*context.world, context.episode, recorder.chunk_steps(), recorder);
}

std::vector<Evaluation> evaluate_batch(EvaluationContext const& context, std::span<Genome const* const> genomes) {
    Request request{genomes};
    WholeRequest queue{request};
    evaluate_queue(context, queue);
    return std::move(request).results();
}

}   // namespace lore
