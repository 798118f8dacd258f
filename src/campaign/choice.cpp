#include <lore/campaign/choice.h>

#include <lore/archive/atomic_file.h>
#include <lore/core/error.h>
#include <lore/core/input_file.h>
#include <lore/core/whole_number.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

constexpr char rule[] =
    "in the order of the campaign's file, the run not yet taken whose best-of-run is nearest to the "
    "level wished, or highest where most is wished; ties: the lowest seed; runs that the campaign names are "
    "taken first";
constexpr char most[] = "most";   ///< in place of a level, of a base with best_of

ChosenRun chosen_from(KnowledgePlan const& knowledge, SourceRun const& run) {
    return {knowledge.name, knowledge.wished_reward, run.run, run.seed, run.reward, knowledge.best_run};
}

}   // namespace

ChosenRun const* Choice::find(std::string_view knowledge) const {
    for (ChosenRun const& entry : chosen)
        if (entry.knowledge == knowledge) return &entry;
    return nullptr;
}

ChosenRun const& Choice::of(std::string_view knowledge) const {
    ChosenRun const* const entry = find(knowledge);
    assert(entry != nullptr);
    return *entry;
}

bool Choice::covers(CampaignPlan const& plan) const {
    return std::all_of(plan.knowledge.begin(), plan.knowledge.end(), [&](KnowledgePlan const& knowledge) {
        bool const counts = source.empty() || knowledge.source == source;
        return knowledge.kind != KnowledgeKind::lineage || !counts || find(knowledge.name) != nullptr;
    });
}

ChosenRun const* Choice::outdated(CampaignPlan const& plan) const {
    for (KnowledgePlan const& wish : plan.knowledge) {
        ChosenRun const* const entry = wish.kind == KnowledgeKind::lineage ? find(wish.name) : nullptr;
        if (entry == nullptr) continue;
        bool const as_wished =
            wish.run != 0 ? entry->run == wish.run
                          : entry->best == wish.best_run && (wish.best_run || entry->wished == wish.wished_reward);
        if (!as_wished) return entry;
    }
    return nullptr;
}

Choice choose_runs(CampaignPlan const& plan, std::vector<SourceRun> const& finished, std::vector<int> without,
                   Choice const& before) {
    Choice choice;
    choice.chosen = before.chosen;
    choice.reward_unit = before.reward_unit;
    choice.source = before.source;
    choice.considered = finished;
    choice.without = std::move(without);
    std::vector<SourceRun> free = finished;
    std::erase_if(free, [&](SourceRun const& run) {
        return std::any_of(before.chosen.begin(), before.chosen.end(),
                           [&](ChosenRun const& taken) { return taken.run == run.run; });
    });
    auto take = [&](std::vector<SourceRun>::iterator at) {
        SourceRun const run = *at;
        free.erase(at);
        return run;
    };

    std::vector<KnowledgePlan const*> wishes;
    for (KnowledgePlan const& knowledge : plan.knowledge)
        if (knowledge.kind == KnowledgeKind::lineage && knowledge.source == before.source &&
            before.find(knowledge.name) == nullptr)
            wishes.push_back(&knowledge);

    for (KnowledgePlan const* wish : wishes) {
        if (wish->run == 0) continue;
        auto const named =
            std::find_if(free.begin(), free.end(), [&](SourceRun const& r) { return r.run == wish->run; });
        if (named == free.end())
            throw Error(fmt::format("cannot take source run {} for '{}'", wish->run, wish->name),
                        "it is not finished, or serves another knowledge base", "Look at 'lore-campaign status'.");
        choice.chosen.push_back(chosen_from(*wish, take(named)));
    }
    for (KnowledgePlan const* wish : wishes) {
        if (wish->run != 0) continue;
        auto const nearest = std::min_element(free.begin(), free.end(), [&](SourceRun const& a, SourceRun const& b) {
            auto const distance = [&](SourceRun const& run) {
                return wish->best_run ? -run.reward : std::abs(run.reward - wish->wished_reward);
            };
            return std::tuple{distance(a), a.seed} < std::tuple{distance(b), b.seed};
        });
        if (nearest == free.end())
            throw Error(fmt::format("no source run is left for '{}'", wish->name),
                        fmt::format("{} runs are finished, {} knowledge bases need one each", finished.size(),
                                    before.chosen.size() + wishes.size()),
                        "Look at 'lore-campaign status'.");
        choice.chosen.push_back(chosen_from(*wish, take(nearest)));
    }
    return choice;
}

void write_choice(std::string const& path, Choice const& choice) {
    std::string const word{reward_word(choice.reward_unit)};
    nlohmann::ordered_json document;
    document["rule"] = rule;
    document["chosen"] = nlohmann::ordered_json::array();
    for (ChosenRun const& entry : choice.chosen)
        document["chosen"].push_back(
            {{"knowledge", entry.knowledge},
             {"wished", entry.best ? nlohmann::ordered_json(most) : nlohmann::ordered_json(entry.wished)},
             {"run", entry.run},
             {"seed", entry.seed},
             {word, json_number<nlohmann::ordered_json>(entry.reward)}});
    document["considered"] = nlohmann::ordered_json::array();
    for (SourceRun const& run : choice.considered)
        document["considered"].push_back(
            {{"run", run.run}, {"seed", run.seed}, {word, json_number<nlohmann::ordered_json>(run.reward)}});
    document["without"] = choice.without;
    if (choice.reward_unit != first_reward_unit) document["reward_unit"] = choice.reward_unit;
    write_file_atomically(path, std::string_view{document.dump(2) + "\n"});
}

Choice read_choice(std::string const& path) {
    try {
        auto const document = nlohmann::json::parse(read_text(path));
        Choice choice;
        choice.reward_unit = document.value("reward_unit", choice.reward_unit);
        std::string const word{reward_word(choice.reward_unit)};
        for (auto const& entry : document.at("chosen")) {
            bool const best = entry.at("wished") == most;
            choice.chosen.push_back({entry.at("knowledge"), best ? 0 : entry.at("wished").get<double>(),
                                     whole_number<int>(entry.at("run")), whole_number<std::uint64_t>(entry.at("seed")),
                                     entry.at(word), best});
        }
        for (auto const& run : document.at("considered"))
            choice.considered.push_back(
                {whole_number<int>(run.at("run")), whole_number<std::uint64_t>(run.at("seed")), run.at(word)});
        for (auto const& run : document.at("without")) choice.without.push_back(whole_number<int>(run));
        return choice;
    } catch (std::exception const& error) {
        throw Error(fmt::format("cannot read {}", path), error.what(), "Remove it to choose the source runs again.");
    }
}

}   // namespace lore
