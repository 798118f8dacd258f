#pragma once

#include <lore/campaign/plan.h>

#include <string>
#include <vector>

namespace lore {

enum class StepKind : std::uint8_t {
    evolve,    ///< one run of lore-evolve
    choose,    ///< decides which source runs the knowledge bases come from
    archive,   ///< a source run once more, keeping all individuals
    build,     ///< one knowledge base
    replay     ///< simulates what the report's pictures of trajectories show
};

/// One piece of work whose outcome is on disk. Names are unique: "source/007", "choose", "archive/kb1_all",
/// "knowledge/kb1", "kb1/012", "replay"; of several sources "NAME/007" and "choose/NAME".
struct Step {
    std::string name;
    StepKind kind = StepKind::evolve;
    std::string group;                  ///< "source", "choose", "archive/kb1_all", "knowledge/kb1", "kb1"
    std::string subject;                ///< name of the treatment, the knowledge base, or the source to choose from
    int run = 0;                        ///< evolve: 1, 2, ...
    std::vector<std::string> after;     ///< groups that must be finished
    bool takes_what_is_there = false;   ///< it can do without those of them that failed
};

/// Whether it is a run of lore-evolve.
inline bool is_run(Step const& step) { return step.kind == StepKind::evolve || step.kind == StepKind::archive; }
/// The name of a step or a group where it may have no '/', which separates directories: "source-007".
std::string flat_name(std::string_view step);

/// All of a campaign, in the order in which it is worked through; every step after those that it waits for.
std::vector<Step> steps_of(CampaignPlan const&);
/// Those with these names, or of these groups, each once and in their order. Throws UsageError for a name that is
/// neither a step nor a group.
std::vector<Step> steps_named(std::vector<Step> const&, std::vector<std::string> const& names);

/// Where a campaign keeps what.
class CampaignDirectory {
public:
    explicit CampaignDirectory(std::string path) : path_(std::move(path)) {}
    std::string const& path() const { return path_; }
    std::string file(std::string_view name) const;
    std::string run(std::string_view step) const;         ///< runs/source/007
    std::string knowledge(std::string_view name) const;   ///< knowledge/kb1.lorekb
    /// knowledge/choice.json, or knowledge/choice-NAME.json of a source with a name of its own
    std::string choice(std::string_view source = "source") const;
    std::string log(std::string_view step) const;      ///< logs/source-007.log
    std::string lock(std::string_view step) const;     ///< steps/source-007.lock
    std::string record(std::string_view step) const;   ///< steps/source-007.json: how the last attempt failed

private:
    std::string path_;
};

/// "choose", or "choose/NAME" of a source with a name of its own.
std::string choose_step(std::string_view source);
/// "source/007".
std::string run_step(std::string_view treatment, int run);
std::uint64_t seed_of(Treatment const&, int run);

struct Choice;

/// "mpirun -n {ranks} --bind-to none"; the program's name is that of the MPI that Lore was built with.
std::string usual_launch();

/// How the programs are called.
struct Launcher {
    std::string programs;   ///< directory of lore-evolve and lore-kb; empty: found by the shell's rules
    std::string campaign_program = "lore-campaign";             ///< for the step "replay"
    int ranks = 1;                                              ///< of one run; 1: started without mpirun
    std::string launch = usual_launch();                        ///< put in front of a run of several ranks
    static constexpr std::string_view ranks_mark = "{ranks}";   ///< in `launch`: their number belongs here
};

/// The step's command line. `choice` is needed by steps that depend on "choose"; what it does not have is named "?".
/// Not for StepKind::choose.
std::vector<std::string> command_of(CampaignPlan const&, CampaignDirectory const&, Launcher const&, Step const&,
                                    Choice const* choice);
/// As a shell takes it.
std::string shell_text(std::vector<std::string> const& command);

}   // namespace lore
