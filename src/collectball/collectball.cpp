#include <lore/collectball/collectball.h>

#include <lore/core/error.h>

#include "stillness.h"

#include <algorithm>

#include <fmt/format.h>

namespace lore {

namespace {

class CollectballLife final : public Life {
public:
    CollectballLife(Arena const& arena, int stop_when_still)
        : arena_(arena), stop_when_still_(stop_when_still), robot_(start_robot(arena)), world_(start_world(arena)) {}

    Position sense(std::span<float> sensors) const override {
        std::ranges::copy(lore::sense(arena_, robot_, world_), sensors.begin());
        return {robot_.pose.x, robot_.pose.y};
    }

    StepResult act(std::span<float const> given) override {
        Effectors effectors;
        std::copy_n(given.begin(), effector_count, effectors.begin());
        int const collected = world_.collected;
        Pose const pose = robot_.pose;
        lore::act(arena_, pose, effectors, world_);
        move(arena_, effectors, world_, robot_);
        bool const over = stop_when_still_ > 0 && is_still(pose, robot_.pose) && ++still_steps_ > stop_when_still_;
        return {static_cast<float>(world_.collected - collected), over};
    }

    void outcome(std::span<float> values) const override { put_outcome(world_, values); }

private:
    Arena const& arena_;
    int stop_when_still_, still_steps_ = 0;
    RobotState robot_;
    WorldState world_;
};

std::vector<ChannelInfo> infos_of(std::span<ChannelEntry const> entries) {
    std::vector<ChannelInfo> infos;
    for (ChannelEntry const& entry : entries)
        infos.push_back({std::string{entry.name}, entry.kind == ChannelKind::binary});
    return infos;
}

WorldFacts facts_of(Arena const& arena) {
    WorldFacts facts;
    facts.name = "collectball";
    facts.task = arena.task.name;
    facts.reward_unit = "balls";
    facts.sensors = infos_of(std::span{channel_table}.first(sensor_count));
    facts.effectors = infos_of(std::span{channel_table}.last(effector_count));
    facts.outcome_size = 2 * static_cast<int>(arena.task.ball_positions.size());
    facts.width = arena.width;
    facts.height = arena.height;
    return facts;
}

std::string rectangles(std::span<Rect const> walls, std::string_view color) {
    std::string all;
    for (Rect const& wall : walls)
        all += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="{}"/>)", wall.x0, wall.y0,
                           wall.x1 - wall.x0, wall.y1 - wall.y0, color);
    return all;
}

std::string light(Point const& at, std::string_view color) {
    return fmt::format(R"(<circle cx="{}" cy="{}" r="8" fill="{}"/>)", at.x, at.y, color);
}

std::unique_ptr<World> open_collectball(std::string const& task, std::string const& settings) {
    if (!settings.empty())
        throw UsageError("collectball refuses its settings", "it has none", "Leave out [world.settings].");
    return std::make_unique<CollectballWorld>(load_arena("collectball", task.empty() ? "source" : task));
}

}   // namespace

CollectballWorld::CollectballWorld(Arena arena, int stop_when_still)
    : arena_(std::move(arena)), stop_when_still_(stop_when_still), facts_(facts_of(arena_)) {
    if (std::string const why = why_invalid(facts_); !why.empty())
        throw UsageError(fmt::format("cannot use arena {} as a world", arena_.name), why, "Mend the arena file.");
}

std::unique_ptr<Life> CollectballWorld::begin() const {
    return std::make_unique<CollectballLife>(arena_, stop_when_still_);
}

std::string CollectballWorld::scene_svg() const {
    std::string scene = "<g>" + rectangles(arena_.walls, "#3a3a3a") + rectangles(arena_.doors, "#8c8c8c");
    for (Point const& ball : arena_.task.ball_positions) scene += light(ball, "#e8a800");
    for (Point const& lamp : arena_.basket_lights) scene += light(lamp, "#2f9e6e");
    return scene + light(arena_.switch_position, "#e0452f") + "</g>";
}

Channels const& collectball_channels() {
    static Channels const channels{infos_of(std::span{channel_table}.first(sensor_count)),
                                   infos_of(std::span{channel_table}.last(effector_count))};
    return channels;
}

void put_outcome(WorldState const& world, std::span<float> values) {
    for (std::size_t ball = 0; ball < values.size() / 2; ++ball) {
        values[2 * ball] = world.released[ball].x;
        values[2 * ball + 1] = world.released[ball].y;
    }
}

BuiltinWorld const collectball_world{"collectball", open_collectball};

}   // namespace lore
