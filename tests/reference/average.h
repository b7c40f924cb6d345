/* average.h - reference: pictures of several samples per pixel, as bytes: by definition the picture of `side` times the
 * size, and of each square of side x side pixels the integer average, half up; of colours by their opacity.
 */
#ifndef ZR_TEST_AVERAGE_H
#define ZR_TEST_AVERAGE_H

#include <stdint.h>

#include "base/arena.h"
#include "scene/scene.h"

/* The scene whose picture has `side` times the width and the height, lines that are as much wider, and points
 * that are as much larger: its meshes lie in the arena. *picture: set to its picture. */
struct zr_scene average_scene(struct zr_arena *arena, const struct zr_scene *scene, struct zr_picture *picture);

/* `samples` has side x side as many pixels as `out`, which has width x height. */
void average_bytes(const uint8_t *samples, uint32_t side, uint32_t width, uint32_t height, uint8_t *out);

/* 1 where one of a pixel's samples is a gap; else as it was. */
void average_gaps(const uint8_t *samples, uint32_t side, uint32_t width, uint32_t height, uint8_t *gaps);

#endif
