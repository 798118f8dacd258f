#pragma once

#include <lore/knowledge/index.h>

namespace lore {

/// Windows of a world whose channels are all continuous: eight values that drift smoothly, each a sum of a few slow
/// sines with phases of its own.
struct SmoothBase {
    KnowledgeConfig config;
    Trace features, questions;
    std::vector<Window> known, asked;   ///< views of these
};

/// 24 000 features and 4 000 questions, half of which match one: the threshold is so chosen. Made once per program.
SmoothBase const& smooth_base();

}   // namespace lore
