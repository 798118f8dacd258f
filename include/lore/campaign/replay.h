#pragma once

#include <lore/campaign/steps.h>
#include <lore/figure/scene.h>

#include <string>
#include <vector>

namespace lore {

/// Where the robot is and what has happened at the beginning of a step: a row of replay.csv.
struct ReplayStep {
    float x = 0, y = 0, theta = 0;
    bool carrying = false, door_open = false, switch_on = false;
    unsigned balls_mask = 0;
    int collected = 0;
};

/// The best-of-run of one run, step by step, in its arena.
struct Replay {
    std::string run;         ///< the campaign's name of the run, "source/007"
    std::string signature;   ///< of that run
    Scene scene;
    std::vector<ReplayStep> steps;
};

/// What a knowledge base, or the product of several, says about the windows of the first replay: values.csv.
struct PanelValues {
    std::string figure;           ///< "figure5" or "figure6"
    std::string knowledge;        ///< names joined by '*'
    std::vector<double> values;   ///< per window; -1 where a single base, 0 where a product does not find it
    std::string checksum = {};    ///< of the knowledge bases' files, joined by '*'; tells whether they are still those
};

/// What the pictures of trajectories need, as the campaign's step "replay" leaves it in three files: replay.csv,
/// values.csv and scene.json (docs/manual/formats.md). The source run that the figures show comes first.
struct Replays {
    std::vector<Replay> replays;
    std::vector<PanelValues> panels;
};

/// scene.json is written last, so that it tells of the others.
void write_replays(CampaignDirectory const&, Replays const&);

/// Empty where there is no scene.json. Throws Error: a damaged file, or files that do not belong together.
Replays read_replays(CampaignDirectory const&);

/// scene.json alone: replays without steps, panels without values.
Replays read_scenes(CampaignDirectory const&);

}   // namespace lore
