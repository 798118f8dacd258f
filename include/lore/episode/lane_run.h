#pragma once

#include <lore/episode/lane_buffers.h>
#include <lore/episode/lanes.h>

#include <span>
#include <vector>

namespace lore {

/// How far the life in a lane comes in a chunk.
struct LaneProgress {
    int rows = 0;        ///< of the chunk that are steps of the life; 0 in an idle lane
    bool over = false;   ///< the world has ended it, with the last of them
};

/// Lives side by side that a kernel steps together: what a LaneWorld brings, so that run_lives does the rest.
class LaneLives {
public:
    virtual ~LaneLives() = default;
    /// A new life in that lane. Idle lanes have one too, which is stepped with the others and not looked at.
    virtual void begin(int lane) = 0;
    /// Steps all lanes, `rows` rows of a chunk: sensors, networks, effectors. A lane's progress comes as the rows that
    /// its life may go on for, none more than `rows`, and leaves as what it did. Appends the rewards of these rows, in
    /// their order.
    virtual void run(LaneBuffers const&, int rows, std::span<LaneProgress>, std::vector<LaneReward>&) = 0;
    /// True if the last row left everything as it was that steps depend on. Asked for lanes whose life goes on.
    virtual bool rests(int) const { return false; }
    /// Life::outcome after the last row of the lane's life in the chunk that was run.
    virtual void outcome(int lane, std::span<float> values) const = 0;
};

/// Runs the client's episodes as run_in_lanes, in lane_count() lives of a world with these facts: gives networks to
/// idle lanes, lays them over each other, shows the chunks and tells the ends.
void run_lives(LaneLives&, WorldFacts const&, EpisodeConfig const&, int chunk_steps, LaneClient&);

}   // namespace lore
