#include <lore/campaign/replay_step.h>

#include <lore/archive/knowledge_file.h>
#include <lore/arena_view/record.h>
#include <lore/campaign/choice.h>
#include <lore/campaign/state.h>
#include <lore/core/error.h>
#include <lore/core/file.h>
#include <lore/episode/episode.h>
#include <lore/experiment/manifest.h>
#include <lore/experiment/run_directory.h>
#include <lore/knowledge/product.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

/// The finished source run that the figures show; "" if there is none yet.
std::string source_run(CampaignPlan const& plan, CampaignDirectory const& directory) {
    if (plan.figures.trajectory.empty()) return "";
    std::string const& source = plan.knowledge_base(plan.figures.trajectory).source;
    auto const choice = recorded_choice(directory, source);
    ChosenRun const* const shown = choice ? choice->find(plan.figures.trajectory) : nullptr;
    if (shown == nullptr) return "";
    Step const step{run_step(source, shown->run), StepKind::evolve, source, source, shown->run, {}};
    return state_of(plan, directory, step, Locks::ignored).status == StepStatus::done ? step.name : "";
}

/// The best of each target task that has finished runs.
std::vector<std::string> best_target_runs(CampaignPlan const& plan, CampaignDirectory const& directory) {
    std::vector<std::string> best;
    for (TaskGroup const& group : task_groups(plan)) {
        std::vector<StepWithState> runs;
        for (std::string const& name : group.treatments)
            for (int run = 1; run <= plan.treatment(name).runs; ++run) {
                Step const step{run_step(name, run), StepKind::evolve, name, name, run, {}};
                runs.push_back({step, state_of(plan, directory, step, Locks::ignored)});
            }
        if (StepWithState const* const first = best_finished_run(runs, group.treatments))
            best.push_back(first->step.name);
    }
    return best;
}

/// Panels that can be drawn: of the knowledge bases that are there.
std::vector<PanelValues> panels_to_draw(CampaignPlan const& plan, CampaignDirectory const& directory) {
    auto const built = [&](std::string const& name) { return is_there(directory.knowledge(name)); };
    auto const panel = [&](std::string const& figure, std::vector<std::string> const& names) {
        std::vector<std::string> checksums;
        for (std::string const& name : names)
            checksums.push_back(record_of("knowledge base", directory.knowledge(name), name).checksum);
        return PanelValues{
            figure, fmt::format("{}", fmt::join(names, "*")), {}, fmt::format("{}", fmt::join(checksums, "*"))};
    };
    std::vector<PanelValues> panels;
    for (std::string const& name : plan.figures.figure5)
        if (built(name)) panels.push_back(panel("figure5", {name}));
    std::vector<std::string> const& factors = plan.figures.figure6;
    if (!factors.empty() && std::all_of(factors.begin(), factors.end(), built))
        panels.push_back(panel("figure6", factors));
    return panels;
}

std::string signature_of(CampaignDirectory const& directory, std::string const& run) {
    return read_manifest((fs::path{directory.run(run)} / run_file::manifest).string()).signature;
}

/// The best-of-run, evaluated once more.
struct Repeated {
    Replay replay;
    Trace trace;
};

Repeated repeat(RunDirectory const& run, std::string const& step, std::string signature) {
    World const& world = *run.world.world;
    Network const network = compile(run.individual("best")->genome);
    Trace trace = record_episode(world, network, run.config.episode);
    Replay replay{step, std::move(signature), world.facts().reward_unit, scene_of(world), {}, {}};
    auto next = trace.rewards.begin();
    double reward = 0;
    for (int k = 0; k < trace.steps(); ++k) {
        Position const at = trace.positions[static_cast<std::size_t>(k)];
        replay.steps.push_back({at.x, at.y, reward});
        for (; next != trace.rewards.end() && next->step == k; ++next) reward += next->amount;
    }
    if (auto const arena = arena_world(run.world.world))
        replay.arena = arena_replay(arena->arena(), record_steps(*arena, network, run.config.episode));
    return {std::move(replay), std::move(trace)};
}

/// The values of the trace's windows by these bases.
void fill_in(PanelValues& panel, std::vector<std::string> const& bases, CampaignDirectory const& directory,
             Trace const& trace) {
    std::vector<FoundValues> values;
    for (std::string const& name : bases) {
        Shaper const shaper{read_knowledge_base(directory.knowledge(name))};
        require_channels(shaper.base(), directory.knowledge(name), trace.channels);
        int const length = shaper.base().config().window_length;
        if (panel.window_length > 0 && length != panel.window_length)
            throw Error("cannot multiply the values of figure 6", fmt::format("{} has another window length", name),
                        "Name others in [report].");
        panel.window_length = length;
        values.push_back(values_of(shaper, windows_of(trace, length)));
    }
    panel.values = product_of(values);
    for (FoundValues const& of_base : values)
        for (std::size_t w = 0; w < of_base.size(); ++w)
            if (!of_base[w]) panel.values[w] = std::numeric_limits<double>::quiet_NaN();
}

}   // namespace

bool can_replay(CampaignPlan const& plan, CampaignDirectory const& directory) {
    return !source_run(plan, directory).empty();
}

std::optional<std::string> replay_is_due(CampaignPlan const& plan, CampaignDirectory const& from,
                                         CampaignDirectory const& into) {
    std::string const source = source_run(plan, from);
    if (source.empty()) return std::nullopt;
    for (char const* const file : {"replay.csv", "values.csv", "scene.json"})
        if (!is_there(into.file(file))) return "not made yet";
    Replays made;
    try {
        made = read_scenes(into);
    } catch (Error const&) { return "scene.json is damaged"; }

    std::vector<std::string> runs = best_target_runs(plan, from);
    runs.insert(runs.begin(), source);
    if (runs.size() != made.replays.size()) return "there are other runs by now";
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (made.replays[i].run != runs[i] || made.replays[i].signature != signature_of(from, runs[i]))
            return fmt::format("it should show {}", runs[i]);

    std::vector<PanelValues> const panels = panels_to_draw(plan, from);
    auto const same = [](PanelValues const& a, PanelValues const& b) {
        return a.figure == b.figure && a.knowledge == b.knowledge && a.checksum == b.checksum;
    };
    if (!std::equal(panels.begin(), panels.end(), made.panels.begin(), made.panels.end(), same))
        return "there are other knowledge bases by now";
    return std::nullopt;
}

Replay replay_of(CampaignDirectory const& directory, std::string const& step) {
    return repeat(open_run(directory.run(step)), step, signature_of(directory, step)).replay;
}

void make_replays(CampaignPlan const& plan, CampaignDirectory const& from, CampaignDirectory const& into) {
    std::string const source = source_run(plan, from);
    if (source.empty())
        throw Error(fmt::format("there is nothing to replay in {}", from.path()),
                    plan.figures.trajectory.empty()
                        ? "[report] names no trajectory"
                        : fmt::format("the source run of '{}' is not chosen or not finished", plan.figures.trajectory),
                    "Look at 'lore-campaign status'.");
    Replays all;
    RunDirectory const run = open_run(from.run(source));
    auto [replay, trace] = repeat(run, source, signature_of(from, source));
    all.replays.push_back(std::move(replay));
    for (std::string const& target : best_target_runs(plan, from)) all.replays.push_back(replay_of(from, target));

    all.panels = panels_to_draw(plan, from);
    for (PanelValues& panel : all.panels)
        fill_in(panel, panel.figure == "figure6" ? plan.figures.figure6 : std::vector{panel.knowledge}, from, trace);
    write_replays(into, all);
}

}   // namespace lore
