#include <lore/arena/collectball.h>

#include <lore/core/error.h>

#include <algorithm>

#include <fmt/format.h>

namespace lore {

namespace {

class CollectballLife final : public Life {
public:
    explicit CollectballLife(Arena const& arena)
        : arena_(arena), robot_(start_robot(arena)), world_(start_world(arena)) {}

    Position sense(std::span<float> sensors) const override {
        std::ranges::copy(lore::sense(arena_, robot_, world_), sensors.begin());
        return {robot_.pose.x, robot_.pose.y};
    }

    StepResult act(std::span<float const> given) override {
        Effectors effectors;
        std::copy_n(given.begin(), effector_count, effectors.begin());
        int const before = world_.collected;
        lore::act(arena_, robot_.pose, effectors, world_);
        move(arena_, effectors, world_, robot_);
        return {static_cast<float>(world_.collected - before), false};
    }

    void outcome(std::span<float> values) const override {
        for (std::size_t ball = 0; ball < values.size() / 2; ++ball) {
            values[2 * ball] = world_.released[ball].x;
            values[2 * ball + 1] = world_.released[ball].y;
        }
    }

private:
    Arena const& arena_;
    RobotState robot_;
    WorldState world_;
};

WorldFacts facts_of(Arena const& arena) {
    WorldFacts facts;
    facts.name = "collectball";
    facts.task = arena.task.name;
    facts.reward_unit = "balls";
    for (ChannelEntry const& entry : channel_table)
        (entry.channel < first_effector ? facts.sensors : facts.effectors)
            .push_back({std::string{entry.name}, entry.kind == ChannelKind::binary});
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

CollectballWorld::CollectballWorld(Arena arena) : arena_(std::move(arena)), facts_(facts_of(arena_)) {
    if (std::string const why = why_invalid(facts_); !why.empty())
        throw UsageError(fmt::format("cannot use arena {} as a world", arena_.name), why, "Mend the arena file.");
}

std::unique_ptr<Life> CollectballWorld::begin() const { return std::make_unique<CollectballLife>(arena_); }

std::string CollectballWorld::scene_svg() const {
    std::string scene = "<g>" + rectangles(arena_.walls, "#3a3a3a") + rectangles(arena_.doors, "#8c8c8c");
    for (Point const& ball : arena_.task.ball_positions) scene += light(ball, "#e8a800");
    for (Point const& lamp : arena_.basket_lights) scene += light(lamp, "#2f9e6e");
    return scene + light(arena_.switch_position, "#e0452f") + "</g>";
}

BuiltinWorld const collectball_world{"collectball", open_collectball};

}   // namespace lore
