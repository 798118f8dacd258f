#pragma once

#include <lore/episode/aligned_floats.h>
#include <lore/episode/lane_tick.h>
#include <lore/network/network.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lore {

/// Owns the networks that lie over each other in the lanes (LaneNetworks).
class LaneNetworkLayout {
public:
    /// Lays the networks anew, in `width` lanes; null, or none at all, for an idle lane. Call after any lane has
    /// changed its network.
    void lay(std::span<Network const* const> networks, int width);
    LaneNetworks view() const;

private:
    std::vector<NeuronGroup> groups_;
    std::vector<std::uint64_t> sources_;
    AlignedFloats weights_;
    int hidden_count_ = 0;
};

}   // namespace lore
