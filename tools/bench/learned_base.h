#pragma once

#include <lore/evolution/individual.h>
#include <lore/knowledge/builder.h>

#include <vector>

namespace lore {

/// What individuals did, as a knowledge base sees it.
struct Recordings {
    std::vector<Trace> traces;
    std::vector<double> rewards;
    std::vector<std::vector<Window>> windows;   ///< [individual], views of the traces

    Recordings(World const&, EpisodeConfig const&, std::vector<Birth const*> const&);
};

/// Ancestors of the populations of three short source runs in which balls were delivered, mixed. The first 600 have
/// 120 000 windows and some 24 000 different features, worth 0 to 4 balls, like the lineage of a run of 4000
/// generations; evolving them takes seconds.
Recordings const& teachers();
inline constexpr int usual_teachers = 600;

/// Windows of 20 steps of the paper's channels.
KnowledgeConfig usual_windows();

/// A knowledge base from the first `individuals` of the teachers (all, if there are fewer).
KnowledgeBase build_base(int individuals, std::unique_ptr<GrowingIndex> empty_index);
/// From the usual ones; built once per program.
KnowledgeBase const& learned_base();

}   // namespace lore
