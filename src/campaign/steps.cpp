#include <lore/campaign/steps.h>

#include "knowledge_kinds.h"
#include "treatment_inputs.h"

#include <lore/campaign/choice.h>
#include <lore/core/error.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include <fmt/format.h>

namespace lore {

namespace {

std::string program(Launcher const& launcher, std::string_view name) {
    return launcher.programs.empty() ? std::string{name} : (std::filesystem::path{launcher.programs} / name).string();
}

std::vector<std::string> evolve_command(CampaignPlan const& plan, Launcher const& launcher, Treatment const& treatment,
                                        std::uint64_t seed, std::string const& out) {
    std::vector<std::string> command;
    if (launcher.ranks > 1) {
        std::istringstream words{launcher.launch};
        for (std::string word; words >> word; command.push_back(word))
            if (std::size_t const at = word.find(Launcher::ranks_mark); at != std::string::npos)
                word.replace(at, Launcher::ranks_mark.size(), std::to_string(launcher.ranks));
    }
    command.insert(command.end(), {program(launcher, "lore-evolve"), plan.config_path(treatment), "--seed",
                                   std::to_string(seed), "--out", out, "--resume"});
    for (std::string const& setting : treatment.overrides) command.insert(command.end(), {"--set", setting});
    return command;
}

std::vector<std::string> build_command(CommandContext const& context, Launcher const& launcher,
                                       KnowledgePlan const& knowledge) {
    std::vector<std::string> command{program(launcher, "lore-kb")};
    auto add = [&](std::vector<std::string> const& words) {
        command.insert(command.end(), words.begin(), words.end());
    };
    add(row_of(knowledge.kind).arguments(knowledge, context));
    if (knowledge.window_length) add({"--window-length", fmt::format("{}", *knowledge.window_length)});
    if (knowledge.match_threshold) add({"--threshold", fmt::format("{}", *knowledge.match_threshold)});
    if (!knowledge.gammas.empty()) {
        command.push_back("--gammas");
        for (double const gamma : knowledge.gammas) command.push_back(fmt::format("{}", gamma));
    }
    if (knowledge.success_reward) add({"--success", fmt::format("{}", *knowledge.success_reward)});
    add(knowledge.options);
    add({"--out", context.directory.knowledge(knowledge.name)});
    return command;
}

void add_runs(CampaignPlan const& plan, Treatment const& treatment, std::vector<Step>& steps) {
    std::vector<std::string> after;
    for (TreatmentInput const& input : treatment_inputs()) {
        if ((treatment.*input.names).empty()) continue;
        std::vector<std::string> const groups = input.prepare(plan, treatment, steps);
        after.insert(after.end(), groups.begin(), groups.end());
    }
    for (int run = 1; run <= treatment.runs; ++run)
        steps.push_back({run_step(treatment.name, run), StepKind::evolve, treatment.name, treatment.name, run, after});
}

void add_build(KnowledgePlan const& knowledge, std::vector<Step>& steps) {
    std::vector<std::string> const after = row_of(knowledge.kind).prepare(knowledge, steps);
    std::string const name = knowledge_step(knowledge.name);
    steps.push_back({name, StepKind::build, name, knowledge.name, 0, after});
}

/// A source whose runs no base comes from needs no choice.
void add_choice(CampaignPlan const& plan, Treatment const& source, std::vector<Step>& steps) {
    if (std::none_of(plan.knowledge.begin(), plan.knowledge.end(),
                     [&](KnowledgePlan const& knowledge) { return knowledge.source == source.name; }))
        return;
    std::string const name = choose_step(source.name);
    steps.push_back({name, StepKind::choose, name, source.name, 0, {source.name}, true});
}

/// After all that the pictures of trajectories may show.
void add_replay(CampaignPlan const& plan, std::vector<Step>& steps) {
    std::vector<std::string> after{choose_step(plan.knowledge_base(plan.figures.trajectory).source)};
    for (std::vector<std::string> const& names : {plan.figures.figure5, plan.figures.figure6})
        for (std::string const& name : names)
            if (std::find(after.begin(), after.end(), knowledge_step(name)) == after.end())
                after.push_back(knowledge_step(name));
    for (Treatment const& target : plan.targets)
        if (target.runs > 0) after.push_back(target.name);
    steps.push_back({"replay", StepKind::replay, "replay", "", 0, after, true});
}

}   // namespace

std::string flat_name(std::string_view step) {
    std::string name{step};
    std::replace(name.begin(), name.end(), '/', '-');
    return name;
}

std::string choose_step(std::string_view source) {
    return source == "source" ? "choose" : fmt::format("choose/{}", source);
}

std::string run_step(std::string_view treatment, int run) {
    return run == 0 ? fmt::format("{}/?", treatment) : fmt::format("{}/{:03}", treatment, run);
}

std::uint64_t seed_of(Treatment const& treatment, int run) {
    return treatment.first_seed + static_cast<std::uint64_t>(run) - 1;
}

std::string CampaignDirectory::file(std::string_view name) const {
    return (std::filesystem::path{path_} / name).string();
}
std::string CampaignDirectory::run(std::string_view step) const { return file(fmt::format("runs/{}", step)); }
std::string CampaignDirectory::knowledge(std::string_view name) const {
    return file(fmt::format("knowledge/{}.lorekb", name));
}
std::string CampaignDirectory::choice(std::string_view source) const {
    return file(source == "source" ? "knowledge/choice.json" : fmt::format("knowledge/choice-{}.json", source));
}
std::string CampaignDirectory::log(std::string_view step) const {
    return file(fmt::format("logs/{}.log", flat_name(step)));
}
std::string CampaignDirectory::lock(std::string_view step) const {
    return file(fmt::format("steps/{}.lock", flat_name(step)));
}
std::string CampaignDirectory::record(std::string_view step) const {
    return file(fmt::format("steps/{}.json", flat_name(step)));
}

std::vector<Step> steps_of(CampaignPlan const& plan) {
    std::vector<Step> steps;
    for (Treatment const& source : plan.sources) add_runs(plan, source, steps);
    for (Treatment const& source : plan.sources) add_choice(plan, source, steps);
    for (KnowledgePlan const& knowledge : plan.knowledge) add_build(knowledge, steps);
    for (Treatment const& target : plan.targets) add_runs(plan, target, steps);
    if (!plan.figures.trajectory.empty()) add_replay(plan, steps);
    return steps;
}

std::vector<Step> steps_named(std::vector<Step> const& steps, std::vector<std::string> const& names) {
    std::set<std::string_view> wanted;   // by name
    for (std::string const& name : names) {
        bool found = false;
        for (Step const& step : steps) {
            if (step.name != name && step.group != name) continue;
            wanted.insert(step.name);
            found = true;
        }
        if (found) continue;
        std::vector<std::string_view> known;
        for (Step const& step : steps) {
            known.push_back(step.name);
            known.push_back(step.group);
        }
        std::string const meant = nearest_word(name, known.data(), known.size());
        throw UsageError(fmt::format("there is no step '{}'", name), "not in this campaign",
                         meant.empty() ? "'lore-campaign plan' lists them." : fmt::format("Did you mean '{}'?", meant));
    }
    std::vector<Step> chosen;
    std::copy_if(steps.begin(), steps.end(), std::back_inserter(chosen),
                 [&](Step const& step) { return wanted.contains(step.name); });
    return chosen;
}

std::string usual_launch() { return LORE_MPIRUN " -n {ranks} --bind-to none"; }

std::vector<std::string> command_of(CampaignPlan const& plan, CampaignDirectory const& directory,
                                    Launcher const& launcher, Step const& step, Choice const* choice) {
    CommandContext const context{plan, directory, choice};
    switch (step.kind) {
    case StepKind::evolve: {
        Treatment const& treatment = plan.treatment(step.subject);
        auto command =
            evolve_command(plan, launcher, treatment, seed_of(treatment, step.run), directory.run(step.name));
        for (TreatmentInput const& input : treatment_inputs()) {
            if ((treatment.*input.names).empty()) continue;
            auto const words = input.arguments(treatment, context);
            command.insert(command.end(), words.begin(), words.end());
        }
        return command;
    }
    case StepKind::archive: {
        KnowledgePlan const& base = plan.knowledge_base(plan.knowledge_base(step.subject).base);
        Treatment const& source = plan.treatment(base.source);
        ChosenRun const* const chosen = choice == nullptr ? nullptr : choice->find(base.name);
        std::uint64_t const seed = chosen == nullptr ? 0 : seed_of(source, chosen->run);
        auto command = evolve_command(plan, launcher, source, seed, directory.run(step.name));
        if (chosen == nullptr) *(std::find(command.begin(), command.end(), "--seed") + 1) = std::string{"?"};
        command.insert(command.end(), {"--archive", "all"});
        return command;
    }
    case StepKind::build: return build_command(context, launcher, plan.knowledge_base(step.subject));
    case StepKind::replay: return {launcher.campaign_program, "replay", plan.path, "--dir", directory.path()};
    case StepKind::choose: break;
    }
    return {};
}

std::string shell_text(std::vector<std::string> const& command) {
    std::string text;
    for (std::string const& word : command) {
        if (!text.empty()) text += ' ';
        bool const plain =
            !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                    "0123456789_-./=:,+@%") == std::string::npos;
        if (plain) {
            text += word;
            continue;
        }
        text += '\'';
        for (char const c : word) c == '\'' ? text += "'\\''" : text += c;
        text += '\'';
    }
    return text;
}

}   // namespace lore
