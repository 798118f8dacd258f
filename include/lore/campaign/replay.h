#pragma once

#include <lore/arena_view/replay.h>
#include <lore/campaign/steps.h>
#include <lore/figure/scene.h>

#include <optional>
#include <string>
#include <vector>

namespace lore {

/// Where a life is at the beginning of a step, and what it has got so far: a row of replay.csv.
struct ReplayStep {
    float x = 0, y = 0;   ///< [u]
    double reward = 0;    ///< of the steps before [reward unit]
};

/// The best-of-run of one run, step by step, in its world.
struct Replay {
    std::string run;         ///< the campaign's name of the run, "source/007"
    std::string signature;   ///< of that run
    std::string reward_unit;
    Scene scene;
    std::vector<ReplayStep> steps;
    std::optional<ArenaReplay> arena;   ///< of a run in an arena: what it shows besides; as many steps
};

/// What a knowledge base, or the product of several, says about the windows of the first replay: values.csv.
struct PanelValues {
    std::string figure;           ///< "figure5" or "figure6"
    std::string knowledge;        ///< names joined by '*'
    std::vector<double> values;   ///< per whole window; NaN: not found, of a product by one of its bases
    std::string checksum = {};    ///< of the knowledge bases' files, joined by '*'; tells whether they are still those
    /// [steps]; 0: not known. read_replays takes files made before 1.0.0, which do not say it, to have a length that
    /// fits.
    int window_length = 0;
};

/// What the pictures of trajectories need, as the campaign's step "replay" leaves it in three files: replay.csv,
/// values.csv and scene.json (docs/manual/formats.md). The source run that the figures show comes first.
struct Replays {
    std::vector<Replay> replays;
    std::vector<PanelValues> panels;
};

/// Whether all of them show an arena, with all that happens in it; if not, all are shown by scene and position alone.
bool all_in_arenas(std::vector<Replay> const&);

/// scene.json is written last, so that it tells of the others.
void write_replays(CampaignDirectory const&, Replays const&);

/// Empty where there is no scene.json. Throws Error: a damaged file, or files that do not belong together.
Replays read_replays(CampaignDirectory const&);

/// scene.json alone: replays without steps, panels without values.
Replays read_scenes(CampaignDirectory const&);

}   // namespace lore
