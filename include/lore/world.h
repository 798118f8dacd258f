/* A world for Lore, in plain C (C99 or later, or C++): the one header that the author of a world needs.
 *
 * A world is a shared library that exports the function `lore_world`. Compile it with
 *
 *     cc -std=c99 -O2 -ffp-contract=off -shared -fPIC -I INCLUDE mine.c -o mine.so -lm
 *
 * where INCLUDE is the folder that has lore/world.h; test it with `lore-world check ./mine.so`.
 * docs/tutorials/own-world.md has the way step by step, docs/examples/pendulum a complete world.
 *
 * WORDS. A *world* is what lore_world_v1.open makes of the settings: one task, with its constants. A *life* is one
 * evaluation of one controller in it, from the start of the world to its end. A *batch* is n lives side by side. At
 * each step Lore asks for the values of the sensors, computes those of the effectors by each life's controller, and
 * lets the world act on them.
 *
 * VALUES. Sensors and effectors lie in [0, 1]; those of a binary channel are 0 or 1. Rewards, positions and outcomes
 * are finite. NaN is an error everywhere. Lore checks each value that it receives and ends the run at a wrong one.
 * Positions and sizes are in u, which is whatever unit of length the world has.
 *
 * ARRAYS of a batch of n lives are [channel][n]: the value of channel c of life i is array[c * n + i]. They belong to
 * Lore, and a call may use them until it returns. The world writes all n values of each channel, those of lives that
 * are over as well, and nothing behind them. Arrays do not overlap.
 *
 * WHAT MUST BE REPEATABLE. A life is a function of the settings and of the effectors it was given: to the bit, whatever
 * its place in the batch, the size of the batch, other lives, other batches and other worlds under way, and whatever
 * has run before. So a world draws nothing at random, reads no clock and no environment, and keeps what changes in the
 * batch, none of it in global or static variables. One that needs noise computes it from a seed among its settings and
 * the number of the step.
 *
 * THREADS. Lore calls a library from one thread at a time. A process may have several worlds of one library open, and
 * several batches of one world under way, whose calls alternate. A world that starts threads ends them before a call
 * returns.
 *
 * OWNERS. What open returns belongs to the library until close, what begin returns until end. Lore calls close after
 * the end of all batches of that world. Texts and arrays that facts and scene_svg point to stay valid and unchanged
 * until close. The settings are valid until open returns.
 *
 * ERRORS. open and begin may fail; the other functions may not. The library does not print, exit, throw through the
 * border, change signal handlers or the floating-point environment.
 *
 * VERSIONS. The struct below, and every rule of this page, is version 1 and does not change: a later version has
 * another struct. Lore reads `version` first, refuses one that it does not know, and then reads nothing else.
 */
#ifndef LORE_WORLD_H
#define LORE_WORLD_H

#define LORE_WORLD_VERSION 1

/* Bounds of what a world may have. */
#define LORE_MOST_SENSORS 64
#define LORE_MOST_EFFECTORS 16
#define LORE_MOST_OUTCOMES 256
#define LORE_MOST_LIVES 1024       /* in a batch */
#define LORE_LONGEST_NAME 40       /* bytes without the final 0 */
#define LORE_LARGEST_SIZE 1000000  /* of the world [u] */
#define LORE_LONGEST_SCENE 1000000 /* bytes without the final 0 */

/* In front of lore_world: callable from C, and exported even by a compiler that is told to hide what is not marked. */
#ifdef __cplusplus
#define LORE_WORLD_LINKAGE extern "C"
#else
#define LORE_WORLD_LINKAGE extern
#endif
#ifdef __GNUC__
#define LORE_WORLD_EXPORT LORE_WORLD_LINKAGE __attribute__((visibility("default")))
#else
#define LORE_WORLD_EXPORT LORE_WORLD_LINKAGE
#endif

/* A sensor or an effector. `name` is an identifier: a lower-case letter, then lower-case letters, digits and '_', at
 * most LORE_LONGEST_NAME; no two channels of a world share one. `binary` is 1 if its values are 0 or 1 only, else 0: a
 * binary effector is 1 where the controller's output is above 0.5. */
typedef struct lore_channel {
    char const* name;
    int binary;
} lore_channel;

/* What does not change while a world is open. Worlds with the same channels in the same order serve the same
 * controllers and knowledge bases; two tasks of one world differ in `task`. */
typedef struct lore_facts {
    char const* name;              /* of the world, an identifier: "pendulum" */
    char const* task;              /* what the settings make of it, an identifier: "short_pole" */
    char const* reward_unit;       /* what axes say, in the plural: "balls"; 1 .. LORE_LONGEST_NAME bytes, UTF-8 */
    int sensor_count;              /* 1 .. LORE_MOST_SENSORS */
    int effector_count;            /* 1 .. LORE_MOST_EFFECTORS */
    int outcome_size;              /* 0 .. LORE_MOST_OUTCOMES numbers that say how a life ended */
    int max_batch;                 /* 1 .. LORE_MOST_LIVES: begin is never asked for more lives */
    lore_channel const* sensors;   /* [sensor_count], in the order of the arrays */
    lore_channel const* effectors; /* [effector_count] */
    float width, height; /* positions lie in [0, width] x [0, height] [u]; above 0, at most LORE_LARGEST_SIZE */
} lore_facts;

typedef struct lore_world_v1 {
    int version; /* LORE_WORLD_VERSION */

    /* Makes a world. `settings` is never NULL; it holds the table [world.settings] of Lore's configuration, a line
     * "key = value\n" for each key, in the order of the alphabet, with values as TOML writes them (0.5, true, "text",
     * [1, 2]); the keys of a table within are "table.key". No settings: "". Keys that the world does not know should be
     * refused, because they are misspelt.
     * Returns NULL where it refuses the settings or has no memory, with the reason in `error`: one line of at most
     * error_size - 1 bytes and a final 0 (snprintf does that). */
    void* (*open)(char const* settings, char* error, int error_size);

    /* The same for each call. */
    lore_facts const* (*facts)(void const* world);

    /* n lives, 1 <= n <= max_batch, at their start, all the same. NULL: no memory. */
    void* (*begin)(void const* world, int n);

    /* What the lives sense now, sensors [sensor_count][n], and where they are now, x [n] and y [n]. Changes nothing.
     * Called before each act; may be called again. */
    void (*sense)(void const* lives, float* sensors, float* x, float* y);

    /* One step by effectors [effector_count][n]. Writes the reward of this step, [n], and over, [n]: 1 if the life has
     * ended with this step (its goal is reached, it has fallen), else 0. Lore ends lives after a number of steps of its
     * configuration in any case. A life that is over stays as it is: act may be called for its batch again, and writes
     * reward 0 and over 1 for it; its outcome does not change. */
    void (*act)(void* lives, float const* effectors, float* reward, unsigned char* over);

    /* How the lives have ended, or would if they ended now, [outcome_size][n]: numbers of similar scale whose Euclidean
     * distance says how different two lives were (the adhoc distance). Changes nothing. */
    void (*outcome)(void const* lives, float* values);

    void (*end)(void* lives);   /* frees a batch, whether its lives are over or not */
    void (*close)(void* world); /* frees a world */

    /* What pictures show behind the paths: one SVG element, for example <g>...</g>, in units of positions with (0, 0)
     * at the top left and y downwards; no scripts, nothing from elsewhere. NULL for none, of the function or the text.
     */
    char const* (*scene_svg)(void const* world);
} lore_world_v1;

/* What the library exports. Returns the same at each call; the struct stays valid while the library is loaded. */
LORE_WORLD_EXPORT lore_world_v1 const* lore_world(void);

#endif
