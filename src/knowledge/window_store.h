#pragma once

#include <lore/core/growing_bytes.h>
#include <lore/knowledge/index.h>

namespace lore {

/// The windows of a growing set, in memory or in files without a name.
class WindowStore {
public:
    /// `folder`: where the files are; empty: in memory. Throws Error.
    WindowStore(KnowledgeConfig const&, std::string const& folder);

    /// Throws Error: a full disk.
    void add(Window const&);
    /// [step][continuous channel]; valid until the next add, and as long as `copy` is left alone. Throws Error.
    float const* values(int feature, std::vector<float>& copy) const;
    /// All; nothing but destruction may follow. Throws Error.
    WindowArrays release();

private:
    Channels channels_;
    std::size_t floats_;   ///< of a window
    GrowingBytes bits_, values_;
};

}   // namespace lore
