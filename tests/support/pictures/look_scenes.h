/* look_scenes.h - support: two small scenes made in memory, with the settings of a look. The same floats on every
 * machine; needs no library (tests/cross). */
#ifndef ZR_TEST_LOOK_SCENES_H
#define ZR_TEST_LOOK_SCENES_H

#include "core.h"
#include "scene/looks.h"
#include "shade/frame.h"

enum { LOOK_SCENES = 2 };

extern const char *const look_scene_names[LOOK_SCENES];

/* Makes a scene in the arena, with the look's view and one output, color. Scene 0: a box with a chamfer, a ball on it,
 * and two lines. Scene 1, double-sided: a plane, a cylinder above it, a patch of a sphere, and a line. NULL without
 * memory. */
const struct zr_scene *look_scene(struct zr_arena *arena, int number, const struct zr_look *look, uint32_t width,
                                  uint32_t height);

/* Returns the FNV-1a hash of the picture, word by word. */
uint64_t look_digest(const struct zr_frame *frame);

/* Window of the committed digests. */
enum { LOOK_WIDTH = 83, LOOK_HEIGHT = 61 };

#endif
