#pragma once

#include <lore/episode/episode.h>

#include <cstdint>
#include <optional>
#include <span>

namespace lore {

/// Most episodes that run side by side, with any instruction set: two vectors of the widest.
inline constexpr int most_lanes = 32;
/// Episodes that run side by side with the active instruction set: 8, 16 or 32.
int lane_count();

/// What up to `width` episodes, running side by side, did in `steps` consecutive steps. The columns belong to lanes;
/// which rows of a column belong to an episode is said by LaneObserver::see. Lives in a buffer that is overwritten by
/// the next chunk, so that it stays in the innermost cache: no trace is ever stored.
struct LaneChunk {
    int width = 0;
    int steps = 0;
    float const* values = nullptr;          ///< [step][6][width], continuous_channels order, as Trace::values
    std::uint16_t const* words = nullptr;   ///< [step][width], as Trace::bits
    float const* x = nullptr;               ///< [step][width], position before the move [u]
    float const* y = nullptr;
};

/// Is shown the episodes of run_in_lanes. Per episode: begin, then see (and at most one rest) until all its steps are
/// told, then end; a lane may begin another episode afterwards.
class LaneObserver {
public:
    virtual ~LaneObserver() = default;
    virtual void begin(int lane, int episode) = 0;
    /// The first valid[lane] rows of the lane's column are the next steps of its episode; 0 for an idle lane.
    virtual void see(LaneChunk const&, std::span<int const> valid) = 0;
    /// The last row that was seen repeats for the episode's remaining `steps` steps: the robot is at rest for good.
    virtual void rest(int lane, int steps) = 0;
    virtual void end(int lane, WorldState const& final_world) = 0;
};

/// Hands out episodes while others run.
class EpisodeSource {
public:
    virtual ~EpisodeSource() = default;
    struct Episode {
        int number = 0;                     ///< what the observer is told
        Network const* network = nullptr;   ///< valid until the observer's end
    };
    /// The next episode, if there is one now; asked again before every chunk while a lane is idle.
    virtual std::optional<Episode> next() = 0;
};

/// Runs all episodes, several at once in the lanes of the active instruction set (core/isa.h), each equal to
/// run_episode to the bit: the fast path. Shows `chunk_steps` steps at a time; every episode starts with a new chunk.
void run_in_lanes(Arena const&, EpisodeConfig const&, std::span<Network const> episodes, int chunk_steps,
                  LaneObserver&);
/// The same for episodes that come one by one, until none runs and the source has none. Cheapest if networks of similar
/// size follow each other.
void run_in_lanes(Arena const&, EpisodeConfig const&, EpisodeSource&, int chunk_steps, LaneObserver&);

}   // namespace lore
