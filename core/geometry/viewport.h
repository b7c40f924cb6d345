/* viewport.h - geometry: clip space -> window space and the subpixel grid.
 *
 * Space:  window coordinates in pixels, y up, pixel (0, 0) has its centre at
 *         (0.5, 0.5). Snapped coordinates count 1/256 pixel from the centre of
 *         pixel (0, 0), so that pixel X, Y has its centre at 256 X, 256 Y.
 * Exact:  the reference's rules 4 and 5.
 */
#ifndef ZR_VIEWPORT_H
#define ZR_VIEWPORT_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum { ZR_SUBPIXEL_BITS = 8, ZR_SUBPIXELS = 1 << ZR_SUBPIXEL_BITS };

/* Snapped coordinates stay below this in magnitude: a window of 16384 pixels.
 * Edge functions are then below 2^46 and fit int64 with room to spare. */
enum { ZR_SNAP_MAX = 1 << (14 + ZR_SUBPIXEL_BITS) };

struct zr_viewport {
    float scale_x, scale_y, trans_x, trans_y;
};

struct zr_window_vertex {
    float x, y, z, oow; /* pixels, depth 0..1, and 1/w of clip space */
    int32_t sx, sy;     /* snapped */
    float eye_z, eye_w; /* homogeneous eye-space depth, for the depth channel */
};

/* The first pixel whose centre is at a snapped coordinate or behind it.
 * Shifts of negative numbers go down to the grid, as all compilers we build with do. */
static inline int32_t zr_viewport_first_centre(int32_t snapped)
{
    return (snapped + ZR_SUBPIXELS - 1) >> ZR_SUBPIXEL_BITS;
}

/* The last one that is not behind it. */
static inline int32_t zr_viewport_last_centre(int32_t snapped)
{
    return snapped >> ZR_SUBPIXEL_BITS;
}

struct zr_viewport zr_viewport_make(uint32_t width, uint32_t height);

/* Fills all of `out` but eye_z and eye_w from a vertex inside the view volume.
 * False where it has no place in the window (w = 0, overflow): not to be drawn. */
bool zr_viewport_apply(const struct zr_viewport *viewport, zr_vec4 clip, struct zr_window_vertex *out);

#endif
