#pragma once

#include "lane_work.h"

#include <lore/collectball/arena.h>

#include <vector>

namespace lore {

/// Owns what a LaneArena points to, beside the Arena itself, which must outlive it.
class LaneArenaLayout {
public:
    explicit LaneArenaLayout(Arena const&);
    LaneArena const& view() const { return view_; }

private:
    std::vector<FaceLine> vertical_, horizontal_;
    std::vector<FaceInterval> intervals_;
    std::vector<LaneLight> lights_;
    LaneArena view_{};
};

}   // namespace lore
