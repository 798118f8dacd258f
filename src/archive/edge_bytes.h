#pragma once

#include <lore/network/genome.h>

#include <cstring>

namespace lore {

/// An edge in files and messages: 6 bytes, without the padding that Edge has in memory.
struct EdgeBytes {
    NeuronIndex source, target;
    unsigned char weight[sizeof(float)];

    EdgeBytes() = default;
    explicit EdgeBytes(Edge const& edge) : source(edge.source), target(edge.target) {
        std::memcpy(weight, &edge.weight, sizeof weight);
    }
    Edge edge() const {
        Edge edge{source, target, 0};
        std::memcpy(&edge.weight, weight, sizeof weight);
        return edge;
    }
};
static_assert(sizeof(EdgeBytes) == 6);

}   // namespace lore
