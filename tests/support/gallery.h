/* gallery.h - support: scenes made in memory that between them reach every part of the kernels.
 *
 * The same floats on every machine: nothing here uses libm but sqrtf, which IEEE 754 says to the bit. Needs no
 * library either, so that it can be built for a machine that has none (tests/cross).
 */
#ifndef ZR_TEST_GALLERY_H
#define ZR_TEST_GALLERY_H

#include "scene/scene.h"
#include "shade/frame.h"
#include "zraster.h"

/* The last scene draws nothing. */
enum { GALLERY_SCENES = 14, GALLERY_WINDOWS = 5, GALLERY_CHANNELS = 4 };

extern const char *const gallery_names[GALLERY_SCENES];
extern const uint32_t gallery_windows[GALLERY_WINDOWS][2]; /* width, height */
extern const char *const gallery_channels[GALLERY_CHANNELS];

/* Lives in the arena. NULL where that has no memory. */
const struct zr_scene *gallery_scene(struct zr_arena *arena, int number, uint32_t width, uint32_t height);

/* A channel of a frame, four bytes a pixel. */
const void *gallery_channel(const struct zr_frame *frame, int channel);

#endif
