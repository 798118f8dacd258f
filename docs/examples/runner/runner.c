/* A body on two legs that runs, seen from the side: joints, motors and contacts by MuJoCo. A world for Lore.
 *
 *     cc -std=c99 -O2 -ffp-contract=off -shared -fPIC runner.c -o runner.so -lmujoco -lm
 *     lore-world check --config source.toml
 *
 * It needs MuJoCo 2.2 (Debian 12: libmujoco-dev). It shows how to bring a model of one's own: MJCF, MuJoCo's XML, is
 * written into memory and compiled by open; a life is an mjData; what MuJoCo would print is kept from the terminal.
 *
 * THE TASK. A torso has a leg at each end, each leg a hip and a knee with a motor and a spring that holds the leg bent.
 * The body moves in the plane of the picture only. It starts standing; a life is over when it lies on its back or at
 * either end of the track. source.toml has flat ground; in target.toml the ground goes up and down in steps of 1.5 m,
 * and the body does not sense what is ahead. The model is the half-cheetah of the reinforcement-learning literature
 * (P. Wawrzynski, A cat-like robot real-time learning to run, ICANNGA 2009); sizes, springs and motors are our own, and
 * there are no ankles.
 *
 * THE REWARD of a step is what the torso has moved forward, in meters. */
#include <lore/world.h>

#include <mujoco/mujoco.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { JOINTS = 4, FEET = 2, BLOCKS = 38, SUBSTEPS = 5 }; /* a step is 0.05 s */
enum { ROOT_X, ROOT_Z, ROOT_PITCH, FIRST_JOINT };         /* in qpos and qvel */
static const float track = 60, sky = 4, ground = 0.5f;    /* width and height of the picture, and what is below 0 [m] */
static const double start = 1.5, margin = 0.5;            /* where lives start, and how near to an end they end [m] */
static const double back = 2;                             /* a torso that has turned so far lies on its back [rad] */
static const double block = 1.5;                          /* length of a step of the ground [m] */

/* Angles in degrees, lengths in meters, torques in N m by `gear`. contype and conaffinity: the body meets the ground
 * only, not itself. The sizes bound the memory of a life: contacts, rows of constraints, numbers on MuJoCo's stack. */
static const char head[] =
    "<mujoco model='runner'><compiler angle='degree'/><option timestep='0.01' iterations='30'/>"
    "<size nconmax='20' njmax='60' nstack='10000'/>"
    "<default><geom contype='1' conaffinity='0' friction='0.9' density='1000' size='0.04'/>"
    "<joint type='hinge' axis='0 -1 0' limited='true' armature='0.1'/>"
    "<motor ctrllimited='true' ctrlrange='-1 1'/></default>"
    "<worldbody><geom name='ground' type='plane' size='80 1 1' contype='0' conaffinity='1'/>";
static const char body[] =
    "<body name='torso' pos='0 0 0.62'>"
    "<joint name='x' type='slide' axis='1 0 0' limited='false' armature='0'/>"
    "<joint name='z' type='slide' axis='0 0 1' limited='false' armature='0'/>"
    "<joint name='pitch' limited='false' armature='0'/>"
    "<geom name='torso' type='capsule' fromto='-0.4 0 0 0.4 0 0' size='0.06'/>"
    "<body pos='-0.4 0 0'><joint name='rear_hip' range='-40 60' stiffness='120' damping='5'/>"
    "<geom type='capsule' fromto='0 0 0 0.12 0 -0.26'/>"
    "<body pos='0.12 0 -0.26'><joint name='rear_knee' range='-50 50' stiffness='90' damping='4'/>"
    "<geom type='capsule' fromto='0 0 0 -0.14 0 -0.26'/>"
    "<geom name='rear_foot' type='sphere' pos='-0.14 0 -0.26' size='0.06'/></body></body>"
    "<body pos='0.4 0 0'><joint name='front_hip' range='-60 40' stiffness='100' damping='4'/>"
    "<geom type='capsule' fromto='0 0 0 -0.1 0 -0.26'/>"
    "<body pos='-0.1 0 -0.26'><joint name='front_knee' range='-50 50' stiffness='70' damping='3'/>"
    "<geom type='capsule' fromto='0 0 0 0.1 0 -0.26'/>"
    "<geom name='front_foot' type='sphere' pos='0.1 0 -0.26' size='0.06'/></body></body>"
    "</body></worldbody>"
    "<actuator><motor joint='rear_hip' gear='100'/><motor joint='rear_knee' gear='80'/>"
    "<motor joint='front_hip' gear='90'/><motor joint='front_knee' gear='60'/></actuator></mujoco>";

static const lore_channel sensors[] = {
    {"rear_hip", 0}, {"rear_knee", 0}, {"front_hip", 0}, {"front_knee", 0}, /* angles */
    {"rear_hip_speed", 0}, {"rear_knee_speed", 0}, {"front_hip_speed", 0}, {"front_knee_speed", 0},
    {"pitch", 0}, {"pitch_speed", 0}, {"forward_speed", 0}, {"upward_speed", 0}, /* of the torso */
    {"rear_foot", 1}, {"front_foot", 1}, {"torso", 1}}; /* on the ground */
enum { SPEEDS = JOINTS, PITCH = 2 * JOINTS, PITCH_SPEED, FORWARD_SPEED, UPWARD_SPEED, TOUCHES };
enum { SENSORS = TOUCHES + FEET + 1 };
static const lore_channel effectors[JOINTS] = {
    {"rear_hip_torque", 0}, {"rear_knee_torque", 0}, {"front_hip_torque", 0}, {"front_knee_torque", 0}}; /* 0.5: none */

typedef struct { /* what open makes: constants */
    double rise; /* of a step of the ground [m] */
    char task[LORE_LONGEST_NAME + 1];
    mjModel *model;
    mjData *standing; /* what every life starts as */
    int touching[FEET + 1]; /* geoms, in the order of the sensors */
    lore_facts facts;
    char scene[8000];
} runner;

typedef struct { /* a life */
    mjData *data;
    int steps, steps_down[FEET]; /* with a foot on the ground */
    int over;
} life;

typedef struct { /* a batch */
    const runner *world;
    int n;
    life lives[]; /* [n] */
} batch;

/* ---- MuJoCo, kept quiet ---- */

/* Left alone, MuJoCo prints its warnings, writes them to a file, and exits at an error. What it calls instead are
 * variables of the process, which other users of MuJoCo have as well: they are ours only while a call lasts. After an
 * error (no memory) MuJoCo cannot go on; abort lets Lore say in which function of which world that was. */
typedef struct {
    void (*warning)(const char *);
    void (*error)(const char *);
} handlers;

static void ignore(const char *text) { (void)text; }
static void give_up(const char *text) {
    (void)text;
    abort();
}

static handlers quiet(void) {
    const handlers before = {mju_user_warning, mju_user_error};
    mju_user_warning = ignore;
    mju_user_error = give_up;
    return before;
}

static void restore(handlers before) {
    mju_user_warning = before.warning;
    mju_user_error = before.error;
}

/* ---- the model ---- */

/* The ground's height on a block: up to two steps high, and down again. */
static double height_of_block(const runner *r, int k) {
    static const int steps[] = {0, 1, 2, 1};
    return steps[k % 4] * r->rise;
}

static double edge_of_block(int k) { return 2 * block + k * block; } /* the start is flat */

/* The model's text, in memory that the caller frees. NULL: none. */
static char *text_of_model(const runner *r) {
    const size_t size = sizeof head + sizeof body + BLOCKS * 120;
    char *text = malloc(size);
    if (text == NULL) return NULL;
    size_t used = (size_t)snprintf(text, size, "%s", head);
    for (int k = 0; k < BLOCKS; k++) {
        const double height = height_of_block(r, k);
        if (height == 0) continue;
        used += (size_t)snprintf(text + used, size - used,
                                 "<geom type='box' pos='%g 0 %g' size='%g 1 %g' contype='0' conaffinity='1'/>",
                                 edge_of_block(k) + block / 2, height / 2, block / 2, height / 2);
    }
    snprintf(text + used, size - used, "%s", body);
    return text;
}

/* mj_loadXML reads files; those of a virtual file system are in memory. NULL, the reason in `error`, where it fails. */
static mjModel *load(const char *text, char *error, int error_size) {
    mjModel *model = NULL;
    mjVFS *files = malloc(sizeof *files);
    if (files == NULL) return NULL;
    mj_defaultVFS(files);
    const int size = (int)strlen(text);
    if (mj_makeEmptyFileVFS(files, "runner.xml", size) == 0) {
        memcpy(files->filedata[mj_findFileVFS(files, "runner.xml")], text, (size_t)size);
        model = mj_loadXML("runner.xml", files, error, error_size);
    }
    mj_deleteVFS(files);
    free(files);
    return model;
}

static void let_stand(runner *r) {
    r->standing = mj_makeData(r->model);
    r->standing->qpos[ROOT_X] = start;
    for (int k = 0; k < 300; k++) mj_step(r->model, r->standing);
    mju_zero(r->standing->qvel, r->model->nv);
    mj_forward(r->model, r->standing);
}

/* ---- the world ---- */

/* The ground, and the body where it starts: its capsules and feet as thick lines. */
static void draw_scene(runner *r) {
    const float floor = sky - ground;
    char *const text = r->scene;
    const size_t size = sizeof r->scene;
    size_t used = (size_t)snprintf(text, size, "<g><path fill=\"#d9cdb8\" d=\"M0 %g V%g", sky, floor);
    for (int k = 0; k < BLOCKS; k++)
        used += (size_t)snprintf(text + used, size - used, " H%g V%g", edge_of_block(k), floor - height_of_block(r, k));
    used += (size_t)snprintf(text + used, size - used,
                             " H%g V%g Z\"/><g stroke=\"#4a6fa5\" stroke-linecap=\"round\">", track, sky);
    for (int g = 0; g < r->model->ngeom; g++) {
        if (r->model->geom_bodyid[g] == 0) continue; /* the ground */
        const mjtNum *at = r->standing->geom_xpos + 3 * g, *turn = r->standing->geom_xmat + 9 * g;
        const double half = r->model->geom_type[g] == mjGEOM_CAPSULE ? r->model->geom_size[3 * g + 1] : 0;
        const double dx = half * turn[2], dz = half * turn[8]; /* along the capsule */
        used += (size_t)snprintf(text + used, size - used,
                                 "<line x1=\"%.3f\" y1=\"%.3f\" x2=\"%.3f\" y2=\"%.3f\" stroke-width=\"%g\"/>",
                                 at[0] - dx, floor - at[2] + dz, at[0] + dx, floor - at[2] - dz,
                                 2 * r->model->geom_size[3 * g]);
    }
    snprintf(text + used, size - used, "</g></g>");
}

/* Sets what the settings say; 0, and the reason in `error`, where they say what this world does not know. */
static int read_settings(runner *r, const char *settings, char *error, int error_size) {
    char line[80], extra;
    int read;
    for (; sscanf(settings, "%79[^\n]%n", line, &read) == 1; settings += read + (settings[read] == '\n')) {
        int end = 0; /* stays so where the closing quote is missing */
        if (sscanf(line, "rise = %lf %c", &r->rise, &extra) == 1 && r->rise >= 0 && r->rise <= 0.3) continue;
        if (sscanf(line, "task = \"%40[a-z0-9_]\"%n", r->task, &end) == 1 && end > 0 && line[end] == 0) continue;
        snprintf(error, (size_t)error_size, "'%s' is neither rise = 0.0 .. 0.3 nor task = \"a_name\"", line);
        return 0;
    }
    return 1;
}

static void close_world(void *world) {
    runner *r = world;
    if (r->standing != NULL) mj_deleteData(r->standing);
    if (r->model != NULL) mj_deleteModel(r->model);
    free(r);
}

static void *open_world(const char *settings, char *error, int error_size) {
    static const char *const touching[FEET + 1] = {"rear_foot", "front_foot", "torso"};
    runner *r = calloc(1, sizeof *r);
    if (r == NULL) return NULL;
    strcpy(r->task, "ground");
    if (!read_settings(r, settings, error, error_size)) {
        close_world(r);
        return NULL;
    }
    const handlers before = quiet();
    char *text = text_of_model(r);
    if (text != NULL) r->model = load(text, error, error_size);
    free(text);
    if (r->model != NULL) let_stand(r);
    restore(before);
    if (r->model == NULL) {
        close_world(r);
        return NULL;
    }
    for (int k = 0; k <= FEET; k++) r->touching[k] = mj_name2id(r->model, mjOBJ_GEOM, touching[k]);
    const lore_facts facts = {"runner", r->task, "meters",  SENSORS, JOINTS, 1 + FEET,
                              256,      sensors, effectors, track,   sky};
    r->facts = facts;
    draw_scene(r);
    return r;
}

static const lore_facts *facts(const void *world) { return &((const runner *)world)->facts; }
static const char *scene_svg(const void *world) { return ((const runner *)world)->scene; }

/* ---- lives ---- */

static void *begin(const void *world, int n) {
    batch *b = calloc(1, sizeof *b + (size_t)n * sizeof b->lives[0]);
    if (b == NULL) return NULL;
    b->world = world;
    b->n = n;
    const handlers before = quiet();
    for (int i = 0; i < n; i++) b->lives[i].data = mj_copyData(NULL, b->world->model, b->world->standing);
    restore(before);
    return b;
}

static void end(void *lives) {
    batch *b = lives;
    for (int i = 0; i < b->n; i++) mj_deleteData(b->lives[i].data);
    free(b);
}

/* Whether a geom meets the ground. MuJoCo looks for contacts where a substep begins: this is as of 0.01 s ago. */
static int touches(const mjData *d, int geom) {
    for (int c = 0; c < d->ncon; c++)
        if (d->contact[c].geom1 == geom || d->contact[c].geom2 == geom) return 1;
    return 0;
}

static float within(double share) { return share < 0 ? 0 : share > 1 ? 1 : (float)share; }

/* Squashes a speed to [0, 1]: 0.5 is none, 0.75 the usual one. */
static float squash(double speed, double usual) { return within(0.5 + 0.5 * speed / (usual + fabs(speed))); }

static void sense_one(const runner *r, const mjData *d, float *values, int n) {
    for (int j = 0; j < JOINTS; j++) {
        const mjtNum *range = r->model->jnt_range + 2 * (FIRST_JOINT + j);
        values[j * n] = within((d->qpos[FIRST_JOINT + j] - range[0]) / (range[1] - range[0]));
        values[(SPEEDS + j) * n] = squash(d->qvel[FIRST_JOINT + j], 5);
    }
    values[PITCH * n] = within(0.5 + 0.5 * d->qpos[ROOT_PITCH] / back);
    values[PITCH_SPEED * n] = squash(d->qvel[ROOT_PITCH], 2);
    values[FORWARD_SPEED * n] = squash(d->qvel[ROOT_X], 2);
    values[UPWARD_SPEED * n] = squash(d->qvel[ROOT_Z], 1);
    for (int k = 0; k <= FEET; k++) values[(TOUCHES + k) * n] = (float)touches(d, r->touching[k]);
}

static void sense(const void *lives, float *values, float *x, float *y) {
    const batch *b = lives;
    const double stand = b->world->model->body_pos[3 + 2]; /* height of the torso, body 1, where ROOT_Z is 0 [m] */
    for (int i = 0; i < b->n; i++) {
        const mjData *d = b->lives[i].data;
        sense_one(b->world, d, values + i, b->n);
        x[i] = track * within(d->qpos[ROOT_X] / track);
        y[i] = sky * within((sky - ground - stand - d->qpos[ROOT_Z]) / sky);
    }
}

/* MuJoCo starts a simulation that runs out of bounds anew, and counts that. */
static int has_failed(const mjData *d) {
    const mjWarningStat *w = d->warning;
    return w[mjWARN_BADQPOS].number + w[mjWARN_BADQVEL].number + w[mjWARN_BADQACC].number > 0;
}

static float move(const runner *r, life *l, const float *values, int n) {
    mjData *d = l->data;
    const double before = d->qpos[ROOT_X];
    for (int j = 0; j < JOINTS; j++) d->ctrl[j] = 2 * (double)values[j * n] - 1;
    for (int k = 0; k < SUBSTEPS; k++) mj_step(r->model, d);
    l->steps++;
    for (int k = 0; k < FEET; k++) l->steps_down[k] += touches(d, r->touching[k]);
    const double x = d->qpos[ROOT_X];
    l->over = has_failed(d) || fabs(d->qpos[ROOT_PITCH]) > back || x < margin || x > track - margin;
    return has_failed(d) ? 0 : (float)(x - before);
}

static void act(void *lives, const float *values, float *reward, unsigned char *over) {
    batch *b = lives;
    const handlers before = quiet();
    for (int i = 0; i < b->n; i++) {
        life *l = &b->lives[i];
        reward[i] = l->over ? 0 : move(b->world, l, values + i, b->n);
        over[i] = (unsigned char)l->over;
    }
    restore(before);
}

static void outcome(const void *lives, float *values) { /* how far [10 m], and the share of steps with each foot down */
    const batch *b = lives;
    for (int i = 0; i < b->n; i++) {
        const life *l = &b->lives[i];
        values[i] = (float)l->data->qpos[ROOT_X] / 10;
        for (int k = 0; k < FEET; k++)
            values[(1 + k) * b->n + i] = l->steps == 0 ? 1 : (float)l->steps_down[k] / (float)l->steps;
    }
}

static const lore_world_v1 functions = {LORE_WORLD_VERSION, open_world, facts, begin,       sense,
                                        act,                outcome,    end,   close_world, scene_svg};

const lore_world_v1 *lore_world(void) { return &functions; }
