/* A pole that hangs from a motor too weak to lift it: it must swing to get up, and then be balanced. A world for Lore.
 *
 *     cc -std=c99 -O2 -ffp-contract=off -shared -fPIC pendulum.c -o pendulum.so -lm
 *     lore-world check --config source.toml
 *
 * The swing-up task of K. Doya, Reinforcement learning in continuous time and space, Neural Computation 12 (2000):
 * pole of 1 m and 1 kg, friction 0.01, torque at most 5 N m (9.8 would lift it), steps of 0.02 s, the cosine of the angle
 * as reward. docs/manual/worlds.md shows its parts. */
#include <lore/world.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265f
enum { RIGHTWARD, UPWARD, TURNING, SENSORS }; /* where the tip is, and how fast the pole turns */

typedef struct { /* what open makes: constants only */
    float length; /* of the pole [m] */
    char task[LORE_LONGEST_NAME + 1];
    lore_facts facts;
} pendulum;

typedef struct { /* one life: the state of the pole */
    float angle, speed; /* from upright [rad], [rad/s] */
    int steps, steps_up;
} pole;

typedef struct { /* a batch */
    const pendulum *world;
    int n;
    pole poles[]; /* [n] */
} batch;

static const lore_channel sensors[SENSORS] = {{"rightward", 0}, {"upward", 0}, {"turning", 0}};
static const lore_channel effectors[] = {{"torque", 0}};

static void *open_world(const char *settings, char *error, int error_size) {
    pendulum *world = malloc(sizeof *world);
    char line[80], extra;
    int read;
    if (world == NULL) return NULL;
    world->length = 1;
    strcpy(world->task, "pole");
    for (; sscanf(settings, "%79[^\n]%n", line, &read) == 1; settings += read + (settings[read] == '\n')) {
        int end = 0; /* stays so where the closing quote is missing */
        if (sscanf(line, "length = %f %c", &world->length, &extra) == 1 && world->length >= 0.1f && world->length <= 10)
            continue;
        if (sscanf(line, "task = \"%40[a-z0-9_]\"%n", world->task, &end) == 1 && end > 0 && line[end] == 0) continue;
        snprintf(error, (size_t)error_size, "'%s' is neither length = 0.1 .. 10.0 nor task = \"a_name\"", line);
        free(world);
        return NULL;
    }
    world->facts = (lore_facts){"pendulum", world->task, "height", SENSORS, 1, 2, 256, sensors, effectors, 0, 0};
    world->facts.width = world->facts.height = 2.2f * world->length; /* the motor is in the middle */
    return world;
}

static const lore_facts *facts(const void *world) { return &((const pendulum *)world)->facts; }

static void *begin(const void *world, int n) {
    batch *lives = malloc(sizeof *lives + (size_t)n * sizeof lives->poles[0]);
    if (lives == NULL) return NULL;
    lives->world = world;
    lives->n = n;
    for (int i = 0; i < n; i++) lives->poles[i] = (pole){PI, 0, 0, 0}; /* hangs still */
    return lives;
}

/* Sensors lie in [0, 1]: from -1 .. 1 and from -10 .. 10 rad/s. */
static float unit(float value) { return value < -1 ? 0 : value > 1 ? 1 : 0.5f + 0.5f * value; }

static void sense(const void *lives, float *values, float *x, float *y) {
    const batch *b = lives;
    for (int i = 0; i < b->n; i++) {
        const float right = sinf(b->poles[i].angle), up = cosf(b->poles[i].angle), length = b->world->length;
        values[RIGHTWARD * b->n + i] = unit(right);
        values[UPWARD * b->n + i] = unit(up);
        values[TURNING * b->n + i] = unit(b->poles[i].speed / 10);
        x[i] = (1.1f + right) * length;
        y[i] = (1.1f - up) * length; /* y grows downwards */
    }
}

static void act(void *lives, const float *torques, float *reward, unsigned char *over) {
    const float mass = 1, gravity = 9.8f, friction = 0.01f, most_torque = 5, step = 0.02f;
    batch *b = lives;
    const float length = b->world->length, inertia = mass * length * length;
    for (int i = 0; i < b->n; i++) {
        pole *p = &b->poles[i];
        const float torque = (2 * torques[i] - 1) * most_torque;
        p->speed += (mass * gravity * length * sinf(p->angle) - friction * p->speed + torque) / inertia * step;
        p->speed = p->speed < -30 ? -30 : p->speed > 30 ? 30 : p->speed;
        p->angle += p->speed * step;
        p->angle += p->angle > PI ? -2 * PI : p->angle < -PI ? 2 * PI : 0;
        p->steps++;
        p->steps_up += cosf(p->angle) > 0.9f;
        reward[i] = cosf(p->angle);
        over[i] = 0; /* lives last as long as the configuration says */
    }
}

static void outcome(const void *lives, float *values) { /* where the pole ends, and how long it was up */
    const batch *b = lives;
    for (int i = 0; i < b->n; i++) {
        values[i] = cosf(b->poles[i].angle);
        values[b->n + i] = b->poles[i].steps == 0 ? 0 : (float)b->poles[i].steps_up / (float)b->poles[i].steps;
    }
}

static const lore_world_v1 functions = {LORE_WORLD_VERSION, open_world, facts, begin, sense, act, outcome, free, free, NULL};

const lore_world_v1 *lore_world(void) { return &functions; }
