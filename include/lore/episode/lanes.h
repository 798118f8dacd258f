#pragma once

#include <lore/episode/episode.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lore {

/// Most episodes that run side by side, with any instruction set: two vectors of the widest.
inline constexpr int most_lanes = 32;
/// Episodes that run side by side with the active instruction set: 8, 16 or 32.
int lane_count();

/// A reward other than 0 that a lane's episode got.
struct LaneReward {
    int lane = 0, row = 0;
    float amount = 0;
};

/// What up to `width` episodes, running side by side, did in `steps` consecutive steps. The columns belong to lanes;
/// LaneClient::see says which rows of a column belong to an episode. Lives in a buffer that is overwritten by
/// the next chunk, so that it stays in the innermost cache: no trace is ever stored.
struct LaneChunk {
    int width = 0;
    int steps = 0;
    float const* values = nullptr;          ///< [step][continuous channel][width], as Trace::values
    std::uint16_t const* words = nullptr;   ///< [step][word][width], as Trace::channel_bits
    float const* x = nullptr;               ///< [step][width], position before the action [u]
    float const* y = nullptr;
    std::span<LaneReward const> rewards;   ///< in order of rows; those of rows that are valid
};

/// How an episode has ended.
struct LaneEnd {
    double reward = 0;                ///< as Trace::reward
    std::span<float const> outcome;   ///< as Trace::outcome
};

/// Hands out the episodes of run_in_lanes and is shown what happens in them.
///
/// Per episode: next, then see (and at most one rest) until all its steps are told, then end; the lane may be given
/// another episode afterwards.
class LaneClient {
public:
    virtual ~LaneClient() = default;
    /// The network of an idle lane's next episode, or null if there is none now; asked before every chunk. The client
    /// keeps it until end(lane). Lanes cost what the largest network among them costs, so networks of similar size
    /// should follow each other.
    virtual Network const* next(int lane) = 0;
    /// The first valid[lane] rows of the lane's column are the next steps of its episode; 0 for an idle lane.
    virtual void see(LaneChunk const&, std::span<int const> valid) = 0;
    /// The last row that was seen repeats for the episode's remaining `steps` steps, without reward: nothing changes
    /// any more.
    virtual void rest(int lane, int steps) = 0;
    virtual void end(int lane, LaneEnd const&) = 0;
};

/// A world that runs episodes in lanes by itself, because it knows a faster way than Lives.
class LaneWorld : public World {
public:
    /// As run_in_lanes.
    virtual void run_in_lanes(EpisodeConfig const&, int chunk_steps, LaneClient&) const = 0;
};

/// Runs the client's episodes until none runs and it has no more, several at once in the lanes of the active
/// instruction set (core/isa.h), each equal to record_episode to the bit: the fast path. Shows `chunk_steps` (at least
/// 1) steps at a time; every episode starts with a new chunk.
///
/// A LaneWorld does it by itself. Of any other the Lives are stepped in batches: a lane waits for its next episode
/// until all lanes have ended theirs.
void run_in_lanes(World const&, EpisodeConfig const&, int chunk_steps, LaneClient&);
/// The second way, for every world.
void run_in_batches(World const&, EpisodeConfig const&, int chunk_steps, LaneClient&);

/// Indices of `networks`, the largest network first: the order in which lanes run them fastest.
std::vector<int> largest_first(std::span<Network const> networks);

}   // namespace lore
