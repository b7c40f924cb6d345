/* look_scenes.h - support: two small scenes, made in memory, as each look has them. The same floats on every machine;
 * needs no library (tests/cross).
 */
#ifndef ZR_TEST_LOOK_SCENES_H
#define ZR_TEST_LOOK_SCENES_H

#include "scene/looks.h"
#include "shade/frame.h"
#include "zraster.h"

enum { LOOK_SCENES = 2 };

extern const char *const look_scene_names[LOOK_SCENES];

/* 0: a box with a chamfer, a ball that lies on it, and two lines. 1, seen from both sides: a plane, a cylinder above
 * it, a patch of a sphere, and a line. The picture alone, in the look's own view. Lives in the arena; NULL where that
 * has no memory. */
const struct zr_scene *look_scene(struct zr_arena *arena, int number, const struct zr_look *look, uint32_t width,
                                  uint32_t height);

/* FNV-1a of the picture, word by word. */
uint64_t look_digest(const struct zr_frame *frame);

/* The window that digests are of. */
enum { LOOK_WIDTH = 83, LOOK_HEIGHT = 61 };

#endif
