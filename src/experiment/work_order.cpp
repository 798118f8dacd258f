#include "work_order.h"

#include "stop_request.h"

#include <lore/core/checksum.h>
#include <lore/archive/knowledge_file.h>
#include <lore/experiment/run.h>
#include <lore/experiment/version.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace lore {

namespace {

constexpr std::string_view ready = "ready";

/// Two builds need not evaluate alike.
std::string this_build() {
    BuildInformation const build = build_information();
    return fmt::format("Lore {}, commit {}", build.version, build.commit);
}

Bytes pack(WorkOrder const& order) {
    auto const json = nlohmann::json::to_cbor({{"build", this_build()},
                                               {"config", to_toml(order.config)},
                                               {"arena", order.arena_text},
                                               {"world_checksum", order.world_checksum},
                                               {"knowledge", order.knowledge_path},
                                               {"knowledge_checksum", order.knowledge_checksum}});
    auto const* const first = reinterpret_cast<std::byte const*>(json.data());
    return {first, first + json.size()};
}

WorkOrder unpack(Bytes const& bytes) {
    auto const* const first = reinterpret_cast<std::uint8_t const*>(bytes.data());
    auto const json = nlohmann::json::from_cbor(first, first + bytes.size());
    if (std::string const build = json.value("build", "an older Lore"); build != this_build())
        throw Error(fmt::format("it runs {}", this_build()), fmt::format("rank 0 runs {}", build),
                    "Install one build on all nodes.");
    WorkOrder order;
    order.config = parse_config(json.at("config").get<std::string>(), "the configuration from rank 0", "");
    order.arena_text = json.at("arena");
    order.world_checksum = json.at("world_checksum");
    order.knowledge_path = json.at("knowledge");
    order.knowledge_checksum = json.at("knowledge_checksum");
    return order;
}

void check_fit(KnowledgeBase const& base, Channels const& channels, ExperimentConfig const& config,
               std::string const& path) {
    auto const refuse = [&](std::string const& reason, std::string const& remedy) {
        throw UsageError(fmt::format("{} does not fit the run", path), reason, remedy);
    };
    KnowledgeConfig const &theirs = base.config(), &ours = config.knowledge;
    if (theirs.window_length != ours.window_length)
        refuse(fmt::format("its windows have {} steps, knowledge.window_length is {}", theirs.window_length,
                           ours.window_length),
               "Build another, or set knowledge.window_length.");
    if (theirs.match_threshold != ours.match_threshold)
        refuse(fmt::format("its threshold is {}, knowledge.match_threshold is {}", theirs.match_threshold,
                           ours.match_threshold),
               "Build another, or set knowledge.match_threshold.");
    if (std::string const why = why_misfit(theirs.channels, channels); !why.empty())
        refuse(why, "Build one from runs in this world.");
    if (base.size() == 0) refuse("it has no features", "Build another.");
}

}   // namespace

void WorkOrder::take_knowledge(std::string const& path) {
    std::error_code failed;
    knowledge_path = std::filesystem::absolute(path, failed).string();
    knowledge_checksum = checksum_text(checksum_of_file(path));
    config.evolution.use_shaping = true;
}

EvaluationContext context_of(WorkOrder const& order, RunWorld world) {
    if (world.origin.checksum != order.world_checksum)
        throw Error(fmt::format("{} on {} is not what rank 0 has", text(world.origin), host_name()),
                    "its checksum differs", "Put it where all ranks see the same file.");
    EvaluationContext context{std::move(world.world), order.config.episode, std::nullopt};
    if (!order.knowledge_path.empty()) {
        KnowledgeBase base = read_knowledge_base(order.knowledge_path);
        if (checksum_text(checksum_of_file(order.knowledge_path)) != order.knowledge_checksum)
            throw Error(fmt::format("{} on {} is not the file that rank 0 has", order.knowledge_path, host_name()),
                        "its checksum differs", "Put it where all ranks see the same file.");
        check_fit(base, Channels{context.world->facts()}, order.config, order.knowledge_path);
        context.shaper.emplace(std::move(base), order.config.evolution.shaping.rule);
    }
    return context;
}

std::vector<std::string> give_order(Session const& session, WorkOrder const& order) {
    session.world().broadcast(pack(order));
    std::vector<std::string> hosts;
    std::string complaint;
    for (std::string const& answer : session.world().gather(std::string{ready} + host_name())) {
        if (answer.starts_with(ready)) hosts.push_back(answer.substr(ready.size()));
        else if (complaint.empty()) complaint = answer;
    }
    // Empty: the other ranks start to work. Anything else: they end, because a rank has failed.
    session.world().broadcast(complaint.empty() ? Bytes{} : Bytes(1));
    if (!complaint.empty()) throw Error("another rank cannot work", complaint, "");
    return hosts;
}

void release_other_ranks(Session const& session) { session.world().broadcast({}); }

void work_for_rank_0(Session const& session) {
    ignore_stop_signals();
    Bytes const order = session.world().broadcast({});
    if (order.empty()) return;
    std::string answer;
    std::optional<EvaluationContext> context;
    try {
        WorkOrder const work = unpack(order);
        context = context_of(work, open_run_world(work.config, work.arena_text));
        answer = std::string{ready} + host_name();
    } catch (std::exception const& error) {
        answer = fmt::format("rank {} on {}: {}", session.rank(), host_name(), error.what());
    }
    session.world().gather(answer);
    if (!session.world().broadcast({}).empty()) return;
    serve(session.world(), *std::move(context));
}

}   // namespace lore
