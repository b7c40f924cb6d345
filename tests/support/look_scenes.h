/* look_scenes.h - support: one small scene, made in memory, as each look has it: a box with a chamfer, a ball that lies
 * on it, and two lines. The same floats on every machine; needs no library (tests/cross).
 */
#ifndef ZR_TEST_LOOK_SCENES_H
#define ZR_TEST_LOOK_SCENES_H

#include "scene/looks.h"
#include "shade/frame.h"
#include "zraster.h"

/* The picture alone, in the look's own view. Lives in the arena; NULL where that has no memory. */
const struct zr_scene *look_scene(struct zr_arena *arena, const struct zr_look *look, uint32_t width, uint32_t height);

/* FNV-1a of the picture, word by word. */
uint64_t look_digest(const struct zr_frame *frame);

/* The window that digests are of. */
enum { LOOK_WIDTH = 83, LOOK_HEIGHT = 61 };

#endif
