/* A robot on two wheels that pushes boxes into a zone, seen from above: contacts and friction by Box2D. A world for
 * Lore.
 *
 *     c++ -std=c++17 -O2 -ffp-contract=off -shared -fPIC pusher.cpp -o pusher.so -lbox2d
 *     lore-world check --config source.toml
 *
 * It needs Box2D 2.4 (Debian: libbox2d-dev). It shows how to keep a physics library to the contract of lore/world.h:
 * each life has a b2World of its own, built in the same order, so that no life knows of another; all numbers that a
 * step needs are in the life; no exception passes the border.
 *
 * THE TASK. The robot starts at the left of a walled field, the zone is the strip at its right. A box counts once its
 * middle is in the zone, and one that is pushed out again counts no more. The life is over when all are in.
 * source.toml has three light boxes. target.toml has five that are as heavy as the robot: two of them at once are more
 * than its wheels can push.
 *
 * THE REWARD of a step. `reward = "way"`: what each box has come nearer to the zone, as a share of its way there, so
 * that a life's rewards add up to the boxes delivered, in fractions. `reward = "boxes"`: whole boxes only. */
#include <lore/world.h>

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace {

// The field: walls around it, the zone right of an edge [m].
constexpr float width = 10, height = 8, zone_edge = 8;
// A robot: a square with two arms in front. Its wheels are left and right of its middle, and each has a greatest speed
// and a greatest force.
constexpr float robot_half = 0.3f, robot_mass = 4, arm_length = 0.2f, arm_half = 0.03f;   // [m], [kg]
constexpr float wheel_place = 0.25f, wheel_speed = 1, wheel_grip = 10;                    // [m], [m/s], [N]
// A box, and what it resists a push for each of its kilograms.
constexpr float box_half = 0.25f, box_grip = 4;   // [m], [N/kg]
constexpr float eyesight = 4, straight = 0.35f;   // length of the rays [m]; what counts as ahead or behind [rad]
constexpr int substeps = 4;                       // of Box2D in a step of 0.1 s
constexpr float substep = 0.1f / substeps;        // [s]

b2Vec2 const robot_start{1.5f, 4};   // it looks to the right; y grows downwards
constexpr int most_boxes = 6;
std::array<b2Vec2, most_boxes> const box_starts{b2Vec2{4, 2.5f},    b2Vec2{4, 5.5f},    b2Vec2{5.5f, 4},
                                                b2Vec2{5.5f, 1.5f}, b2Vec2{5.5f, 6.5f}, b2Vec2{7, 4}};

// Rays, first, tell how much of their length is free of walls and boxes. zone_ahead and zone_right are a compass: 1 and
// 0.5 where the robot looks to the zone, 0 and 0.5 where it looks away. box_... tell of the nearest box outside the
// zone: how near, and on which side. touching: the robot touches a box.
constexpr std::array<lore_channel, 14> sensors{{{"range_left", 0},
                                                {"range_front_left", 0},
                                                {"range_front", 0},
                                                {"range_front_right", 0},
                                                {"range_right", 0},
                                                {"zone_ahead", 0},
                                                {"zone_right", 0},
                                                {"box_near", 0},
                                                {"box_ahead", 1},
                                                {"box_right", 1},
                                                {"box_behind", 1},
                                                {"box_left", 1},
                                                {"touching", 1},
                                                {"in_zone", 1}}};
constexpr std::array<float, 5> ray_angles{-b2_pi / 2, -b2_pi / 4, 0, b2_pi / 4, b2_pi / 2};   // from ahead [rad]
enum { zone_ahead = 5, zone_right, box_near, box_ahead, box_right, box_behind, box_left, touching, in_zone };
constexpr std::array<lore_channel, 2> effectors{{{"left_wheel", 0}, {"right_wheel", 0}}};   // 0.5 stands still

b2Vec2 arm_place(float side) { return {robot_half + arm_length / 2, side * (robot_half - arm_half)}; }

// ---- one life ----

/// The nearest thing on a ray that is not the robot.
class Ray : public b2RayCastCallback {
public:
    explicit Ray(b2Body const* robot) : robot_(robot) {}
    float ReportFixture(b2Fixture* fixture, b2Vec2 const&, b2Vec2 const&, float fraction) override {
        if (fixture->GetBody() == robot_) return -1;   // goes on as if it were not there
        share = fraction;
        return fraction;   // nothing farther away is of interest
    }
    float share = 1;

private:
    b2Body const* robot_;
};

class Life {
public:
    Life(int boxes, float box_mass) : boxes_(static_cast<std::size_t>(boxes)) {
        b2BodyDef fixed;
        b2Body* const ground = world_.CreateBody(&fixed);
        std::array<b2Vec2, 4> const corners{b2Vec2{0, 0}, b2Vec2{width, 0}, b2Vec2{width, height}, b2Vec2{0, height}};
        for (std::size_t k = 0; k < corners.size(); ++k) {
            b2EdgeShape wall;
            wall.SetTwoSided(corners[k], corners[(k + 1) % corners.size()]);
            ground->CreateFixture(&wall, 0);
        }
        make_robot();
        for (std::size_t b = 0; b < boxes_.size(); ++b) boxes_[b] = make_box(ground, box_starts[b], box_mass);
    }

    void sense(float* values, int n) const {
        auto const set = [&](int sensor, float value) { values[sensor * n] = std::clamp(value, 0.0f, 1.0f); };
        b2Vec2 const at = robot_->GetPosition();
        for (std::size_t k = 0; k < ray_angles.size(); ++k) {
            Ray ray{robot_};
            b2Rot const direction{robot_->GetAngle() + ray_angles[k]};
            world_.RayCast(&ray, at, at + eyesight * direction.GetXAxis());
            set(static_cast<int>(k), ray.share);
        }
        b2Vec2 const zone = robot_->GetLocalVector({1, 0});
        set(zone_ahead, 0.5f + 0.5f * zone.x);
        set(zone_right, 0.5f + 0.5f * zone.y);
        b2Vec2 const box = robot_->GetLocalPoint(nearest_box());
        float const bearing = std::atan2(box.y, box.x);
        set(box_near, 1 - box.Length() / width);
        set(box_ahead, std::abs(bearing) <= straight);
        set(box_right, bearing > straight && bearing <= b2_pi - straight);
        set(box_behind, std::abs(bearing) > b2_pi - straight);
        set(box_left, bearing < -straight && bearing >= straight - b2_pi);
        set(touching, touches_box());
        set(in_zone, at.x > zone_edge);
    }

    void act(float left, float right) {
        for (int k = 0; k < substeps; ++k) {
            drive(left, right);
            world_.Step(substep, 8, 3);
        }
    }

    b2Vec2 robot() const { return robot_->GetPosition(); }
    b2Vec2 box(std::size_t b) const { return boxes_[b]->GetPosition(); }
    std::size_t boxes() const { return boxes_.size(); }
    bool delivered(std::size_t b) const { return box(b).x > zone_edge; }
    bool over() const {
        for (std::size_t b = 0; b < boxes(); ++b)
            if (!delivered(b)) return false;
        return true;
    }

private:
    void make_robot() {
        b2BodyDef body;
        body.type = b2_dynamicBody;
        body.position = robot_start;
        robot_ = world_.CreateBody(&body);
        b2PolygonShape chassis, arm;
        float const area = 4 * robot_half * robot_half;
        chassis.SetAsBox(robot_half, robot_half);
        robot_->CreateFixture(&chassis, robot_mass / area);
        for (float const side : {-1.0f, 1.0f}) {   // a box between the arms does not slip off
            arm.SetAsBox(arm_length / 2, arm_half, arm_place(side), 0);
            robot_->CreateFixture(&arm, 0);
        }
    }

    b2Body* make_box(b2Body* ground, b2Vec2 const& place, float mass) {
        b2BodyDef body;
        body.type = b2_dynamicBody;
        body.position = place;
        b2Body* const box = world_.CreateBody(&body);
        b2PolygonShape square;
        square.SetAsBox(box_half, box_half);
        box->CreateFixture(&square, mass / (4 * box_half * box_half));
        b2FrictionJointDef floor;   // seen from above, the floor is a joint that resists up to a force and a torque
        floor.Initialize(ground, box, place);
        floor.maxForce = box_grip * mass;
        floor.maxTorque = box_grip * mass * box_half;
        world_.CreateJoint(&floor);
        return box;
    }

    /// Each wheel pushes at its place for the speed it wants, forward, and against any slip to the side; its grip
    /// bounds the force.
    void drive(float left, float right) {
        std::array<float, 2> const wanted{(2 * left - 1) * wheel_speed, (2 * right - 1) * wheel_speed};
        std::array<b2Vec2, 2> pushes, places;
        for (std::size_t k = 0; k < 2; ++k) {
            b2Vec2 const wheel{0, k == 0 ? -wheel_place : wheel_place};
            places[k] = robot_->GetWorldPoint(wheel);
            b2Vec2 const speed = robot_->GetLocalVector(robot_->GetLinearVelocityFromLocalPoint(wheel));
            b2Vec2 push = robot_->GetMass() / 2 * b2Vec2{wanted[k] - speed.x, -speed.y};   // [N s]
            float const most = wheel_grip * substep;
            if (push.Length() > most) push *= most / push.Length();
            pushes[k] = robot_->GetWorldVector(push);
        }
        for (std::size_t k = 0; k < 2; ++k) robot_->ApplyLinearImpulse(pushes[k], places[k], true);
    }

    /// Of those outside the zone; the last box where there is none.
    b2Vec2 nearest_box() const {
        b2Vec2 nearest = box(boxes() - 1);
        float least = b2_maxFloat;
        for (std::size_t b = 0; b < boxes(); ++b) {
            float const distance = b2DistanceSquared(box(b), robot());
            if (delivered(b) || distance >= least) continue;
            least = distance;
            nearest = box(b);
        }
        return nearest;
    }

    bool touches_box() const {
        for (b2ContactEdge const* edge = robot_->GetContactList(); edge != nullptr; edge = edge->next)
            if (edge->contact->IsTouching() && edge->other->GetType() == b2_dynamicBody) return true;
        return false;
    }

    b2World world_{b2Vec2{0, 0}};   // seen from above: no gravity
    b2Body* robot_ = nullptr;
    std::vector<b2Body*> boxes_;   // bodies belong to world_
};

// ---- the world ----

struct Pusher {   // what open makes: constants
    int boxes = 2;
    float mass = 1;   // of a box [kg]
    bool rewards_way = true;
    char task[LORE_LONGEST_NAME + 1] = "boxes";
    std::string scene;
    lore_facts facts{};
};

struct Lives {   // a batch
    Pusher const& world;
    std::vector<std::unique_ptr<Life>> lives;
};

/// Sets what the line says; false where it says nothing that this world knows.
bool set(Pusher& world, char const* line) {
    std::string const text = line;
    char extra;
    if (text == "reward = \"way\"" || text == "reward = \"boxes\"") {
        world.rewards_way = text == "reward = \"way\"";
        return true;
    }
    int end = 0;   // stays so where the closing quote is missing
    if (std::sscanf(line, "task = \"%40[a-z0-9_]\"%n", world.task, &end) == 1 && end > 0 && line[end] == '\0')
        return true;
    if (std::sscanf(line, "boxes = %d %c", &world.boxes, &extra) == 1)
        return world.boxes >= 1 && world.boxes <= most_boxes;
    return std::sscanf(line, "mass = %f %c", &world.mass, &extra) == 1 && world.mass >= 0.1f && world.mass <= 10;
}

std::string rectangle(b2Vec2 const& middle, b2Vec2 const& half, char const* color) {
    char text[160];
    std::snprintf(text, sizeof text, "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"%s\"/>",
                  middle.x - half.x, middle.y - half.y, 2 * half.x, 2 * half.y, color);
    return text;
}

std::string scene_of(Pusher const& world) {
    constexpr char const *zone = "#cfe8dc", *wall = "#3a3a3a", *box = "#c08a4a", *robot = "#4a6fa5";
    std::string scene =
        "<g>" + rectangle({(zone_edge + width) / 2, height / 2}, {(width - zone_edge) / 2, height / 2}, zone);
    for (float const side : {0.0f, 1.0f}) {
        scene += rectangle({side * width, height / 2}, {0.05f, height / 2}, wall);
        scene += rectangle({width / 2, side * height}, {width / 2, 0.05f}, wall);
    }
    for (int b = 0; b < world.boxes; ++b)
        scene += rectangle(box_starts[static_cast<std::size_t>(b)], {box_half, box_half}, box);
    for (float const side : {-1.0f, 1.0f})
        scene += rectangle(robot_start + arm_place(side), {arm_length / 2, arm_half}, robot);
    return scene + rectangle(robot_start, {robot_half, robot_half}, robot) + "</g>";
}

void* open_world(char const* settings, char* error, int error_size) try {
    auto world = std::make_unique<Pusher>();
    char line[80];
    int read = 0;
    for (; std::sscanf(settings, "%79[^\n]%n", line, &read) == 1; settings += read + (settings[read] == '\n')) {
        if (set(*world, line)) continue;
        std::snprintf(
            error, static_cast<std::size_t>(error_size),
            "'%s' is none of boxes = 1 .. %d, mass = 0.1 .. 10.0, reward = \"way\" or \"boxes\", task = \"a_name\"",
            line, most_boxes);
        return nullptr;
    }
    world->scene = scene_of(*world);
    // A life takes 220 KB, most of it the stack and the pools of its b2World: hence the bound of a batch.
    world->facts = {
        "pusher",       world->task,      "boxes", sensors.size(), effectors.size(), 2 + 2 * world->boxes, 64,
        sensors.data(), effectors.data(), width,   height};
    return world.release();
} catch (...) { return nullptr; }

lore_facts const* facts(void const* world) { return &static_cast<Pusher const*>(world)->facts; }
char const* scene_svg(void const* world) { return static_cast<Pusher const*>(world)->scene.c_str(); }
void close_world(void* world) { delete static_cast<Pusher*>(world); }

void* begin(void const* world, int n) try {
    auto const& pusher = *static_cast<Pusher const*>(world);
    auto batch = std::make_unique<Lives>(Lives{pusher, {}});
    for (int i = 0; i < n; ++i) batch->lives.push_back(std::make_unique<Life>(pusher.boxes, pusher.mass));
    return batch.release();
} catch (...) { return nullptr; }

void end(void* lives) { delete static_cast<Lives*>(lives); }

void sense(void const* lives, float* values, float* x, float* y) {
    auto const& batch = static_cast<Lives const*>(lives)->lives;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        batch[i]->sense(values + i, static_cast<int>(batch.size()));
        x[i] = std::clamp(batch[i]->robot().x, 0.0f, width);
        y[i] = std::clamp(batch[i]->robot().y, 0.0f, height);
    }
}

/// How much of its way to the zone a box has behind it; of whole boxes: whether it is there.
float progress(Pusher const& world, Life const& life, std::size_t b) {
    if (!world.rewards_way) return life.delivered(b) ? 1 : 0;
    return 1 - std::max(0.0f, zone_edge - life.box(b).x) / (zone_edge - box_starts[b].x);
}

void act(void* lives, float const* values, float* reward, unsigned char* over) {
    auto const& [world, batch] = *static_cast<Lives*>(lives);
    for (std::size_t i = 0; i < batch.size(); ++i) {
        Life& life = *batch[i];
        reward[i] = 0;
        if (!life.over()) {
            std::array<float, most_boxes> before{};
            for (std::size_t b = 0; b < life.boxes(); ++b) before[b] = progress(world, life, b);
            life.act(values[i], values[batch.size() + i]);
            for (std::size_t b = 0; b < life.boxes(); ++b) reward[i] += progress(world, life, b) - before[b];
        }
        over[i] = life.over();
    }
}

void outcome(void const* lives, float* values) {   // where the robot and the boxes are [m]
    auto const& batch = static_cast<Lives const*>(lives)->lives;
    std::size_t const n = batch.size();
    for (std::size_t i = 0; i < n; ++i) {
        auto const set = [&](std::size_t place, b2Vec2 const& at) {
            values[2 * place * n + i] = at.x;
            values[(2 * place + 1) * n + i] = at.y;
        };
        set(0, batch[i]->robot());
        for (std::size_t b = 0; b < batch[i]->boxes(); ++b) set(b + 1, batch[i]->box(b));
    }
}

constexpr lore_world_v1 functions{LORE_WORLD_VERSION, open_world, facts, begin, sense, act, outcome, end,
                                  close_world,        scene_svg};

}   // namespace

lore_world_v1 const* lore_world(void) { return &functions; }
