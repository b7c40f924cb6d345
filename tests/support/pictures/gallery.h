/* gallery.h - support: scenes made in memory that together run every part of the kernels.
 *
 * Exact:  the same floats on every machine: sqrtf, which IEEE 754 defines to the bit, is the only function of libm.
 * Needs:  no library, so that other targets can build it (tests/cross).
 */
#ifndef ZR_TEST_GALLERY_H
#define ZR_TEST_GALLERY_H

#include "core.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* The last scene draws nothing. */
enum { GALLERY_SCENES = 14, GALLERY_WINDOWS = 5, GALLERY_CHANNELS = 4 };

extern const char *const gallery_names[GALLERY_SCENES];
extern const uint32_t gallery_windows[GALLERY_WINDOWS][2]; /* width, height */
extern const char *const gallery_channels[GALLERY_CHANNELS];

/* Makes a scene in the arena. NULL without memory. */
const struct zr_scene *gallery_scene(struct zr_arena *arena, int number, uint32_t width, uint32_t height);

/* Returns a channel of a frame, four bytes per pixel. */
const void *gallery_channel(const struct zr_frame *frame, int channel);

#endif
