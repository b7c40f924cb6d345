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

#include "base/mutant.h"
#include "base/vec.h"

enum { ZR_SUBPIXEL_BITS = 8, ZR_SUBPIXELS = 1 << ZR_SUBPIXEL_BITS };

/* Snapped coordinates stay below this in magnitude: a window of 16384 pixels.
 * Edge functions are then below 2^46 and fit int64 with room to spare. */
enum { ZR_SNAP_MAX = 1 << (14 + ZR_SUBPIXEL_BITS) };

/* What is drawn into. */
struct zr_window {
    uint32_t width, height; /* pixels */
    int32_t line_width;     /* of lines and outlines, pixels */
    float point_scale;      /* how many times as large as their sizes points are; 0: all are one pixel */
};

struct zr_viewport {
    float scale_x, scale_y, trans_x, trans_y;
};

/* Sixteen bytes, so that kernels load one at once: snapping again is cheaper than fetching it. */
struct zr_window_vertex {
    float x, y, z, oow; /* pixels, depth 0..1, and 1/w of clip space */
};

/* To the nearest, ties to even, as rule 5 has it, where the result is below ZR_SNAP_MAX: a float from 2^23 on has
 * no bits left for a fraction. Beyond, what comes out is beyond too. (rintf is a call, but for SSE4.1.) */
static inline float zr_viewport_snap(float window)
{
    const float no_fraction = 12582912.0f; /* 1.5 * 2^23 */
    const float subpixels = (window - 0.5f) * (float)ZR_SUBPIXELS;
    return (ZR_MUTANT(ties_up, subpixels, subpixels + 0.01f) + no_fraction) - no_fraction;
}

/* Snapped coordinates of a vertex that has a place in the window. */
static inline int32_t zr_snapped_x(const struct zr_window_vertex *vertex)
{
    return (int32_t)zr_viewport_snap(vertex->x);
}
static inline int32_t zr_snapped_y(const struct zr_window_vertex *vertex)
{
    return (int32_t)zr_viewport_snap(vertex->y);
}

/* Which corner of a triangle changes places with corner 0 where the area is negative, by rule 6. */
static inline int zr_swapped_corner(void)
{
    return ZR_MUTANT(swaps_corner_2, 1, 2);
}

/* The reference's area, rule 6: twice that of the snapped triangle, less than 0 where it goes counter-clockwise. */
static inline int64_t zr_window_area(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                                     const struct zr_window_vertex *v2)
{
    int64_t dx01 = zr_snapped_x(v0) - zr_snapped_x(v1), dy01 = zr_snapped_y(v0) - zr_snapped_y(v1);
    int64_t dx20 = zr_snapped_x(v2) - zr_snapped_x(v0), dy20 = zr_snapped_y(v2) - zr_snapped_y(v0);
    return dx01 * dy20 - dx20 * dy01;
}

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

/* Fills `out` from a vertex inside the view volume. False where it has no place in the window (w = 0, overflow): not to
 * be drawn. */
bool zr_viewport_apply(const struct zr_viewport *viewport, zr_vec4 clip, struct zr_window_vertex *out);

#endif
