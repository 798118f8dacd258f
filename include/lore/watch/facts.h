#pragma once

#include <lore/campaign/state.h>

#include <optional>
#include <string>
#include <vector>

namespace lore {

/// A point of a mean curve: the best-of-run of the runs that have reached the generation.
struct MeanPoint {
    int generation = 0;
    double mean = 0;   ///< [reward unit]
    int runs = 0;
    friend bool operator==(MeanPoint const&, MeanPoint const&) = default;
};

/// At most 201 points from generation 0 to the last that any run has reached. `runs`: reward of the best by
/// generation.
std::vector<MeanPoint> mean_curve(std::vector<std::vector<double>> const& runs);

/// How far the runs of a treatment have come.
struct TreatmentFacts {
    std::string name, label;
    bool is_source = false;
    std::string target, target_label;   ///< of its target task; "" where the campaign names none
    int planned = 0;                    ///< runs
    int started = 0;                    ///< of them, those with a generation
    int done = 0, running = 0, failed = 0;
    double mean_reward = 0;    ///< of the best so far of those started
    double best_reward = 0;    ///< of all of them
    std::string reward_unit;   ///< "" as long as it is not known
    std::vector<MeanPoint> curve;
};

struct FailureFacts {
    std::string step, reason;
    std::string log;                 ///< path
    std::vector<std::string> tail;   ///< its last lines, as the failure was recorded; may be empty
};

/// The finished run of a task with most reward, the first among equals in the report's order.
struct Champion {
    std::string run;     ///< "kb1/007"
    std::string label;   ///< of its treatment
    double reward = 0;
    std::string reward_unit;
    std::string signature;   ///< of that run
    std::string problem;     ///< why it cannot be replayed; empty if it can
};

/// A campaign as its directory shows it at one time: what the page, the JSON document and the terminal show.
struct CampaignFacts {
    std::string title, directory;
    std::string time;     ///< UTC, ISO 8601
    std::string notice;   ///< what people should know first: that the directory is not there yet, or cannot be read
    std::vector<StepWithState> steps;
    std::vector<TreatmentFacts> treatments;   ///< the source task first, then in the report's order
    std::vector<FailureFacts> failures;       ///< the first 50
    std::vector<Champion> champions;          ///< of the source task and of the target task, one each
    double share = 0;                         ///< of the planned generations, 0 to 1
    std::optional<double> seconds_left;       ///< at the present number of runs; nothing if none is running
    int count(StepStatus) const;              ///< steps
};

/// The facts as a JSON document, in the fields of docs/manual/formats.md. Text that is no UTF-8 is replaced.
std::string facts_json(CampaignFacts const&);

}   // namespace lore
