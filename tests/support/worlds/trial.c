/* A world that keeps its contract, or breaks one rule of it: `fault = "..."` among its settings says which. Three
 * variants of the library break what is read before: see the macros. */
#include <lore/world.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef TRIAL_VERSION
#define TRIAL_VERSION LORE_WORLD_VERSION
#endif
#ifndef TRIAL_ENTRY
#define TRIAL_ENTRY lore_world
#endif
#ifndef TRIAL_ACT
#define TRIAL_ACT act
#endif

enum { PHASE, FLAG, ECHO, SENSORS, EFFECTORS = 2, PATIENCE = 600 };

typedef struct {
    char fault[40];
    lore_channel sensors[LORE_MOST_SENSORS + 1], effectors[EFFECTORS];
    lore_facts facts;
} trial;

typedef struct {
    int steps, grips, over;
    float sum, echo;
} life;

typedef struct {
    const trial *world;
    int n;
    life lives[];
} batch;

/* What only faulty worlds use. */
static int acts_so_far, ended_early;
static float shared;

static int is(const trial *world, const char *fault) { return strcmp(world->fault, fault) == 0; }

static void *open_trial(const char *settings, char *error, int error_size) {
    trial *w = calloc(1, sizeof *w);
    if (w == NULL) return NULL;
    if (settings[0] != '\0' && sscanf(settings, "fault = \"%39[a-z_]\"", w->fault) != 1) {
        snprintf(error, (size_t)error_size, "it does not know\n%s", settings);
        free(w);
        return NULL;
    }
    w->sensors[PHASE].name = "phase";
    w->sensors[FLAG].name = is(w, "two_names") ? "phase" : is(w, "upper_case") ? "Flag" : "flag";
    w->sensors[FLAG].binary = is(w, "half_binary") ? 2 : 1;
    w->sensors[ECHO].name = is(w, "no_name") ? NULL : "echo";
    w->effectors[0].name = "push";
    w->effectors[1].name = "grip";
    w->effectors[1].binary = 1;
    w->facts.name = "trial";
    w->facts.task = is(w, "no_task") ? "" : "plain";
    w->facts.reward_unit = is(w, "no_unit") ? NULL : "pushes";
    w->facts.sensor_count = is(w, "no_sensors") ? 0 : is(w, "many_sensors") ? 65 : SENSORS;
    w->facts.effector_count = is(w, "many_effectors") ? 17 : EFFECTORS;
    w->facts.outcome_size = is(w, "many_outcomes") ? 257 : 1;
    w->facts.max_batch = is(w, "no_batch") ? 0 : is(w, "alone") ? 1 : 64;
    w->facts.sensors = w->sensors;
    w->facts.effectors = is(w, "no_effectors") ? NULL : w->effectors;
    w->facts.width = is(w, "no_width") ? (float)NAN : 2;
    w->facts.height = is(w, "no_height") ? 0 : 2;
    return w;
}

static const lore_facts *facts(const void *world) {
    return is(world, "no_facts") ? NULL : &((const trial *)world)->facts;
}

static void *begin(const void *world, int n) {
    batch *b = is(world, "no_begin") ? NULL : calloc(1, sizeof *b + (size_t)n * sizeof b->lives[0]);
    if (b == NULL) return NULL;
    b->world = world;
    b->n = n;
    shared = 0;
    for (int i = 0; i < n && is(world, "leftover"); i++) b->lives[i].sum = (float)ended_early;
    if (is(world, "leak")) b->lives[0].echo = malloc(100) != NULL ? 0.0f : 1.0f;
    return b;
}

static void sense(const void *lives, float *sensors, float *x, float *y) {
    const batch *b = lives;
    const trial *w = b->world;
    const int n = b->n;
    for (int i = 0; i < n; i++) {
        const life *l = &b->lives[is(w, "neighbor") && i > 0 ? i - 1 : i];
        float phase = 0.5f + 0.5f * sinf(l->sum);
        if (is(w, "counter")) phase = (float)(acts_so_far % 1000) / 1000;
        if (is(w, "batch_size")) phase = 1 / (float)n;
        if (is(w, "shared")) phase = 0.5f + 0.5f * sinf(shared);
        if (is(w, "sense_moves")) ((life *)(size_t)l)->sum += 0.01f;
        sensors[PHASE * n + i] = phase;
        sensors[FLAG * n + i] = l->echo > 0.5f;
        if (!is(w, "unwritten") || i < n - 1) sensors[ECHO * n + i] = l->echo;
        x[i] = 1 + sinf(l->sum);
        y[i] = 1 + cosf(l->sum);
        if (l->steps != 17 || i != n - 1) continue;
        if (is(w, "nan_sensor")) sensors[PHASE * n + i] = (float)NAN;
        if (is(w, "sensor_range")) sensors[ECHO * n + i] = 1.25f;
        if (is(w, "binary")) sensors[FLAG * n + i] = 0.25f;
        if (is(w, "position")) x[i] = -3;
    }
    if (is(w, "overrun")) sensors[SENSORS * n] = 0;
}

static void act(void *lives, const float *effectors, float *reward, unsigned char *over) {
    batch *b = lives;
    const trial *w = b->world;
    acts_so_far++;
    shared += 0.1f;
    for (int i = 0; i < b->n; i++) {
        life *l = &b->lives[i];
        const float push = effectors[i];
        reward[i] = is(w, "late_reward") && l->over ? 1 : 0;
        if (!l->over) {
            l->echo = push;
            l->sum += push - 0.5f;
            l->steps++;
            l->grips += effectors[b->n + i] > 0.5f;
            l->over = l->grips > PATIENCE;
            reward[i] = push - 0.5f;
        }
        over[i] = (unsigned char)(is(w, "revives") && l->steps % 2 == 0 ? !l->over && l->grips > 3 : l->over);
        if (l->steps != 17) continue;
        if (is(w, "infinite_reward")) reward[i] = (float)INFINITY;
        if (is(w, "over")) over[i] = 2;
        while (is(w, "hang") && b->n > 0) over[i] = 0;
        if (is(w, "crash")) *(volatile int *)(size_t)(l->steps - 17) = 1;
    }
}

static void outcome(const void *lives, float *values) {
    const batch *b = lives;
    for (int i = 0; i < b->n; i++) values[i] = is(b->world, "outcome") ? (float)NAN : b->lives[i].sum;
}

static void end(void *lives) {
    const int steps = ((batch *)lives)->lives[0].steps;
    ended_early = steps > 0 && steps < 20;
    free(lives);
}

static const char *scene_svg(const void *world) {
    return is(world, "scene") ? "<g><line></g>" : is(world, "scene_text") ? "a picture" : "<g><circle r=\"1\"/></g>";
}

static const lore_world_v1 functions = {TRIAL_VERSION, open_trial, facts, begin, sense, TRIAL_ACT, outcome, end, free,
                                        scene_svg};

const lore_world_v1 *TRIAL_ENTRY(void);
const lore_world_v1 *TRIAL_ENTRY(void) { return &functions; }
