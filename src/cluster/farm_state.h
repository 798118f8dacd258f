#pragma once

#include "post.h"

#include <lore/cluster/farm.h>

#include <utility>

namespace lore {

/// What the farm of evaluations and that of distances share: the way to the other ranks, and whether they still serve.
struct FarmState {
    explicit FarmState(Communicator group) : communicator(std::move(group)), post(communicator.handle().comm) {}

    int ranks() const { return communicator.size(); }
    /// After an exception: the other ranks may be at work, and their replies are never received.
    void give_up() {
        working = false;
        broken = ranks() > 1;
    }

    Communicator communicator;
    Post post;
    RankTimes times;       ///< of rank 0
    bool working = true;   ///< the others are in serve()
    bool broken = false;
};

}   // namespace lore
