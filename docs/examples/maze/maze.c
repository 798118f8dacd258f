/* A robot that has to find its way out of a maze: the navigation task of the novelty-search literature, where walls lead
 * those astray that only come nearer to the goal. A world for Lore.
 *
 *     cc -std=c99 -O2 -ffp-contract=off -shared -fPIC maze.c -o maze.so -lm
 *     lore-world check --config medium.toml
 *
 * WHERE THE NUMBERS COME FROM. The task: J. Lehman and K. O. Stanley, Abandoning objectives: evolution through the search
 * for novelty alone, Evolutionary Computation 19 (2011), "maze navigation experiment": six range finders, four pie-slice
 * sensors that point to the goal, two effectors that change the turning speed and the speed, 400 steps, two mazes. The
 * coordinates of the walls, starts and goals are those of the files medium_maze.txt and hard_maze.txt that accompany
 * reimplementations of the experiment (goNEAT_NS; I. Omelianenko, Hands-On Neuroevolution with Python, 2019), and so are
 * radius 8, range 100, greatest speed 3 [u/step] and greatest turn 3 [degrees/step], sectors of 90 degrees, and a goal
 * that is reached within 5 [u]. Here a sensor's value is the share of its range that is free.
 *
 * THE REWARD. On the way, what a step gains in distance to the goal, as a share of the first distance: all steps add up
 * to 1 - last distance / first distance, the objective whose deception the literature shows. The step that reaches the
 * goal adds 1, and the life is over. With `reward = "goal"` there is only that 1. */
#include <lore/world.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265f
#define DEGREE (PI / 180)

enum { WALLS = 11, RANGES = 6, SLICES = 4, SENSORS = RANGES + SLICES, EFFECTORS = 2 };
static const float radius = 8, range = 100, most_speed = 3, most_turn = 3 * DEGREE, goal_radius = 5; /* [u], [rad] */

typedef struct {
    float x0, y0, x1, y1;
} wall;

typedef struct {
    const char *name;
    float width, height; /* [u] */
    float start_x, start_y, goal_x, goal_y;
    wall walls[WALLS];
} plan;

static const plan plans[] = {
    {"medium", 300, 140, 30, 22, 270, 100,
     {{5, 5, 295, 5}, {295, 5, 295, 135}, {295, 135, 5, 135}, {5, 135, 5, 5},
      {241, 135, 58, 65}, {114, 5, 73, 42}, {130, 91, 107, 46}, {196, 5, 139, 51},
      {219, 125, 182, 63}, {267, 5, 214, 63}, {271, 135, 237, 88}}},
    {"hard", 205, 205, 36, 184, 31, 20,
     {{5, 5, 5, 200}, {5, 200, 200, 200}, {200, 200, 200, 5}, {200, 5, 5, 5},
      {5, 49, 57, 53}, {56, 54, 56, 157}, {57, 106, 158, 162}, {77, 200, 108, 164},
      {5, 80, 33, 121}, {200, 146, 87, 91}, {56, 55, 133, 30}}},
};

static const lore_channel sensors[SENSORS] = {
    {"range_left", 0}, {"range_front_left", 0}, {"range_front", 0}, {"range_front_right", 0}, {"range_right", 0},
    {"range_back", 0}, {"goal_front", 1}, {"goal_right", 1}, {"goal_back", 1}, {"goal_left", 1}};
static const float range_angles[RANGES] = {-90, -45, 0, 45, 90, 180}; /* from the heading; y grows downwards */
static const lore_channel effectors[EFFECTORS] = {{"turn", 0}, {"thrust", 0}};

typedef struct { /* what open makes */
    const plan *plan;
    int rewards_way; /* or only the goal */
    float first_distance;
    lore_facts facts;
    char scene[2048];
} maze;

typedef struct { /* a life */
    float x, y, heading, speed, turn; /* [u], [rad], [u/step], [rad/step] */
    float distance;                   /* to the goal */
    int over;
} robot;

typedef struct { /* a batch */
    const maze *maze;
    int n;
    robot robots[]; /* [n] */
} batch;

/* ---- geometry ---- */

static float distance_to_wall(const wall *w, float x, float y) {
    const float dx = w->x1 - w->x0, dy = w->y1 - w->y0;
    float share = ((x - w->x0) * dx + (y - w->y0) * dy) / (dx * dx + dy * dy);
    share = share < 0 ? 0 : share > 1 ? 1 : share;
    const float gap_x = w->x0 + share * dx - x, gap_y = w->y0 + share * dy - y;
    return sqrtf(gap_x * gap_x + gap_y * gap_y);
}

/* How far a ray from (x, y) in direction (cx, cy), of length 1, goes until it meets the wall; at most `most`. */
static float distance_along(const wall *w, float x, float y, float cx, float cy, float most) {
    const float dx = w->x1 - w->x0, dy = w->y1 - w->y0, across = cx * dy - cy * dx;
    if (across == 0) return most; /* parallel */
    const float rx = w->x0 - x, ry = w->y0 - y;
    const float along = (rx * dy - ry * dx) / across, share = (rx * cy - ry * cx) / across;
    return along >= 0 && share >= 0 && share <= 1 && along < most ? along : most;
}

static float distance_to_goal(const plan *p, float x, float y) {
    return sqrtf((p->goal_x - x) * (p->goal_x - x) + (p->goal_y - y) * (p->goal_y - y));
}

static int stands_free(const plan *p, float x, float y) {
    for (int w = 0; w < WALLS; w++)
        if (distance_to_wall(&p->walls[w], x, y) < radius) return 0;
    return 1;
}

/* ---- the world ---- */

static void draw_scene(maze *m) {
    const plan *p = m->plan;
    int used = snprintf(m->scene, sizeof m->scene,
                        "<g><circle cx=\"%g\" cy=\"%g\" r=\"%g\" fill=\"#2f9e6e\"/>"
                        "<g stroke=\"#3a3a3a\" stroke-width=\"2\">",
                        p->goal_x, p->goal_y, goal_radius);
    for (int w = 0; w < WALLS; w++)
        used += snprintf(m->scene + used, sizeof m->scene - (size_t)used,
                         "<line x1=\"%g\" y1=\"%g\" x2=\"%g\" y2=\"%g\"/>", p->walls[w].x0, p->walls[w].y0, p->walls[w].x1,
                         p->walls[w].y1);
    snprintf(m->scene + used, sizeof m->scene - (size_t)used, "</g></g>");
}

/* Sets what the line says; 0 where it says nothing that this world knows. */
static int set(maze *m, const char *line) {
    if (strcmp(line, "maze = \"medium\"") == 0) m->plan = &plans[0];
    else if (strcmp(line, "maze = \"hard\"") == 0) m->plan = &plans[1];
    else if (strcmp(line, "reward = \"way\"") == 0) m->rewards_way = 1;
    else if (strcmp(line, "reward = \"goal\"") == 0) m->rewards_way = 0;
    else return 0;
    return 1;
}

static void *open_world(const char *settings, char *error, int error_size) {
    char line[80];
    int read;
    maze *m = malloc(sizeof *m);
    if (m == NULL) return NULL;
    m->plan = &plans[0];
    m->rewards_way = 1;
    for (; sscanf(settings, "%79[^\n]%n", line, &read) == 1; settings += read + (settings[read] == '\n')) {
        if (set(m, line)) continue;
        snprintf(error, (size_t)error_size, "'%s' is neither maze = \"medium\" or \"hard\" nor reward = \"way\" or \"goal\"",
                 line);
        free(m);
        return NULL;
    }
    m->first_distance = distance_to_goal(m->plan, m->plan->start_x, m->plan->start_y);
    const lore_facts facts = {"maze",    m->plan->name, "way", SENSORS,          EFFECTORS,      2,
                              LORE_MOST_LIVES, sensors, effectors, m->plan->width, m->plan->height};
    m->facts = facts;
    draw_scene(m);
    return m;
}

static const lore_facts *facts(const void *world) { return &((const maze *)world)->facts; }
static const char *scene_svg(const void *world) { return ((const maze *)world)->scene; }

/* ---- lives ---- */

static void *begin(const void *world, int n) {
    const maze *m = world;
    const robot start = {m->plan->start_x, m->plan->start_y, 0, 0, 0, m->first_distance, 0};
    batch *b = malloc(sizeof *b + (size_t)n * sizeof b->robots[0]);
    if (b == NULL) return NULL;
    b->maze = m;
    b->n = n;
    for (int i = 0; i < n; i++) b->robots[i] = start;
    return b;
}

static void sense_one(const plan *p, const robot *r, float *values, int n) {
    for (int k = 0; k < RANGES; k++) {
        const float angle = r->heading + range_angles[k] * DEGREE, cx = cosf(angle), cy = sinf(angle);
        float free_way = range;
        for (int w = 0; w < WALLS; w++) free_way = distance_along(&p->walls[w], r->x, r->y, cx, cy, free_way);
        values[k * n] = free_way / range;
    }
    /* The goal in the robot's frame; the sector of 90 degrees around each axis in which it lies. */
    const float gx = p->goal_x - r->x, gy = p->goal_y - r->y, c = cosf(r->heading), s = sinf(r->heading);
    const float forward = gx * c + gy * s, right = gy * c - gx * s;
    const int sector = fabsf(forward) >= fabsf(right) ? (forward >= 0 ? 0 : 2) : (right >= 0 ? 1 : 3);
    for (int k = 0; k < SLICES; k++) values[(RANGES + k) * n] = k == sector;
}

static void sense(const void *lives, float *values, float *x, float *y) {
    const batch *b = lives;
    for (int i = 0; i < b->n; i++) {
        sense_one(b->maze->plan, &b->robots[i], values + i, b->n);
        x[i] = b->robots[i].x;
        y[i] = b->robots[i].y;
    }
}

static float within(float value, float most) { return value < -most ? -most : value > most ? most : value; }

/* The effectors speed up by at most half a unit or degree a step; a robot that would touch a wall stays where it is. */
static void move(const plan *p, robot *r, float turn, float thrust) {
    r->turn = within(r->turn + (turn - 0.5f) * DEGREE, most_turn);
    r->speed = within(r->speed + (thrust - 0.5f), most_speed);
    const float x = r->x + cosf(r->heading) * r->speed, y = r->y + sinf(r->heading) * r->speed;
    r->heading += r->turn;
    r->heading += r->heading > PI ? -2 * PI : r->heading < -PI ? 2 * PI : 0;
    if (stands_free(p, x, y)) {
        r->x = x;
        r->y = y;
    }
}

static void act(void *lives, const float *values, float *reward, unsigned char *over) {
    batch *b = lives;
    const maze *m = b->maze;
    for (int i = 0; i < b->n; i++) {
        robot *r = &b->robots[i];
        reward[i] = 0;
        if (!r->over) {
            const float before = r->distance;
            move(m->plan, r, values[i], values[b->n + i]);
            r->distance = distance_to_goal(m->plan, r->x, r->y);
            r->over = r->distance < goal_radius;
            if (m->rewards_way) reward[i] = (before - r->distance) / m->first_distance;
            if (r->over) reward[i] += 1;
        }
        over[i] = (unsigned char)r->over;
    }
}

static void outcome(const void *lives, float *values) { /* where the robot ends: the behavior of the literature */
    const batch *b = lives;
    for (int i = 0; i < b->n; i++) {
        values[i] = b->robots[i].x;
        values[b->n + i] = b->robots[i].y;
    }
}

static const lore_world_v1 functions = {LORE_WORLD_VERSION, open_world, facts, begin, sense, act, outcome, free, free,
                                        scene_svg};

const lore_world_v1 *lore_world(void) { return &functions; }
