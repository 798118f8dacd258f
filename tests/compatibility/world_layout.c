/* Prints how the compiler lays lore/world.h out: bounds, then the size of each struct, then offset and size of each
 * member. release.py compares it with that of a release: a library that was compiled then is loaded now. */
#include <lore/world.h>

#include <stddef.h>
#include <stdio.h>

#define BOUND(name) printf(#name " %d\n", name)
#define STRUCT(name) printf(#name " %zu\n", sizeof(name))
#define MEMBER(name, member) \
    printf(#name "." #member " %zu %zu\n", offsetof(name, member), sizeof(((name *)0)->member))

int main(void) {
    BOUND(LORE_WORLD_VERSION);
    BOUND(LORE_MOST_SENSORS);
    BOUND(LORE_MOST_EFFECTORS);
    BOUND(LORE_MOST_OUTCOMES);
    BOUND(LORE_MOST_LIVES);
    BOUND(LORE_LONGEST_NAME);
    BOUND(LORE_LARGEST_SIZE);
    BOUND(LORE_LONGEST_SCENE);
    STRUCT(lore_channel);
    MEMBER(lore_channel, name);
    MEMBER(lore_channel, binary);
    STRUCT(lore_facts);
    MEMBER(lore_facts, name);
    MEMBER(lore_facts, task);
    MEMBER(lore_facts, reward_unit);
    MEMBER(lore_facts, sensor_count);
    MEMBER(lore_facts, effector_count);
    MEMBER(lore_facts, outcome_size);
    MEMBER(lore_facts, max_batch);
    MEMBER(lore_facts, sensors);
    MEMBER(lore_facts, effectors);
    MEMBER(lore_facts, width);
    MEMBER(lore_facts, height);
    STRUCT(lore_world_v1);
    MEMBER(lore_world_v1, version);
    MEMBER(lore_world_v1, open);
    MEMBER(lore_world_v1, facts);
    MEMBER(lore_world_v1, begin);
    MEMBER(lore_world_v1, sense);
    MEMBER(lore_world_v1, act);
    MEMBER(lore_world_v1, outcome);
    MEMBER(lore_world_v1, end);
    MEMBER(lore_world_v1, close);
    MEMBER(lore_world_v1, scene_svg);
    return 0;
}
