/* random_scenes.h - support: scenes in JSON with any values of the keys that a picture has.
 */
#ifndef ZR_TEST_RANDOM_SCENES_H
#define ZR_TEST_RANDOM_SCENES_H

#include <stdint.h>

/* The scene of this number, on every machine. Each can be read and drawn, and none takes long: small meshes, and few
 * samples. Overwritten by the next call. */
const char *random_scene(uint64_t number);

#endif
