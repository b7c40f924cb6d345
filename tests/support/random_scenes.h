/* random_scenes.h - support: random scenes in JSON, with any values of the picture's keys. */
#ifndef ZR_TEST_RANDOM_SCENES_H
#define ZR_TEST_RANDOM_SCENES_H

#include <stdint.h>

/* Returns scene `number`, the same on every machine; the next call overwrites it. All scenes are valid and fast to
 * draw: small meshes and few samples. */
const char *random_scene(uint64_t number);

#endif
