/* A world that does nothing: what it takes is what Lore takes for a world in a library. */
#include <lore/world.h>

#include <stdlib.h>

enum { SENSORS = 3 };
static const lore_channel sensors[SENSORS] = {{"first", 0}, {"second", 0}, {"third", 0}};
static const lore_channel effectors[] = {{"only", 0}};
static const lore_facts the_facts = {"nothing",       "nothing", "points",  SENSORS, 1, 0,
                                     LORE_MOST_LIVES, sensors,   effectors, 1,       1};

static void *open_world(const char *settings, char *error, int error_size) {
    (void)settings, (void)error, (void)error_size;
    return malloc(1);
}

static const lore_facts *facts(const void *world) {
    (void)world;
    return &the_facts;
}

static void *begin(const void *world, int n) {
    int *count = malloc(sizeof *count);
    (void)world;
    if (count != NULL) *count = n;
    return count;
}

static void sense(const void *lives, float *values, float *x, float *y) {
    const int n = *(const int *)lives;
    for (int i = 0; i < SENSORS * n; i++) values[i] = 0.5f;
    for (int i = 0; i < n; i++) x[i] = y[i] = 0.5f;
}

static void act(void *lives, const float *values, float *reward, unsigned char *over) {
    const int n = *(const int *)lives;
    (void)values;
    for (int i = 0; i < n; i++) reward[i] = 0;
    for (int i = 0; i < n; i++) over[i] = 0;
}

static void outcome(const void *lives, float *values) { (void)lives, (void)values; }

static const lore_world_v1 functions = {LORE_WORLD_VERSION, open_world, facts, begin, sense, act, outcome, free, free,
                                        NULL};

const lore_world_v1 *lore_world(void) { return &functions; }
