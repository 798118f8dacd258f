#pragma once

#include "process_link.h"

#include <lore/world/process.h>

namespace lore {

/// A world behind the frames of a process (process.h).
class ProcessWorld final : public World {
public:
    /// Throws UsageError and Error as start_world.
    ProcessWorld(WorldProcess const&, std::string const& settings);

    WorldFacts const& facts() const override { return facts_; }
    std::unique_ptr<Life> begin() const override;
    std::unique_ptr<Lives> begin_lives(int count) const override;
    std::string scene_svg() const override { return scene_; }

    ProcessLink& link() const { return link_; }
    std::uint32_t next_batch() const { return ++batches_; }

private:
    WorldFacts facts_;
    std::string scene_;
    mutable ProcessLink link_;   ///< what a call to it changes is no state of the world
    mutable std::uint32_t batches_ = 0;
};

}   // namespace lore
