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

/* Bound of the magnitude of snapped coordinates: a window of 16384 pixels. Edge functions are then below 2^46 and fit
 * int64 with room to spare. */
enum { ZR_SNAP_MAX = 1 << (14 + ZR_SUBPIXEL_BITS) };

/* Render target: its size, and the pixel sizes of lines and points. */
struct zr_window {
    uint32_t width, height; /* pixels */
    int32_t line_width;     /* width of lines and outlines, pixels */
    float point_scale;      /* factor from point sizes to pixels; 0: all points are one pixel */
};

struct zr_viewport {
    float scale_x, scale_y, trans_x, trans_y;
};

/* Sixteen bytes, so that kernels load a vertex at once. Recomputing snapped coordinates is cheaper than loading
 * them. */
struct zr_window_vertex {
    float x, y, z, oow; /* pixels, depth 0..1, and 1/w of clip space */
};

/* Rounds to the nearest 1/256 pixel, ties to even (rule 5), if the result is below ZR_SNAP_MAX: a float from 2^23 on
 * has no fraction bits. Larger inputs give results of at least ZR_SNAP_MAX. (rintf is a function call without
 * SSE4.1.) */
static inline float zr_viewport_snap(float window)
{
    const float no_fraction = 12582912.0f; /* 1.5 * 2^23 */
    const float subpixels = (window - 0.5f) * (float)ZR_SUBPIXELS;
    return (ZR_MUTANT(ties_up, subpixels, subpixels + 0.01f) + no_fraction) - no_fraction;
}

/* Snapped coordinates of a vertex that has a window position. */
static inline int32_t zr_snapped_x(const struct zr_window_vertex *vertex)
{
    return (int32_t)zr_viewport_snap(vertex->x);
}
static inline int32_t zr_snapped_y(const struct zr_window_vertex *vertex)
{
    return (int32_t)zr_viewport_snap(vertex->y);
}

/* Returns the corner that rule 6 swaps with corner 0 if the area is negative. */
static inline int zr_swapped_corner(void)
{
    return ZR_MUTANT(swaps_corner_2, 1, 2);
}

/* Returns the reference's area (rule 6): twice that of the snapped triangle, negative if it is counter-clockwise. */
static inline int64_t zr_window_area(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                                     const struct zr_window_vertex *v2)
{
    int64_t dx01 = zr_snapped_x(v0) - zr_snapped_x(v1), dy01 = zr_snapped_y(v0) - zr_snapped_y(v1);
    int64_t dx20 = zr_snapped_x(v2) - zr_snapped_x(v0), dy20 = zr_snapped_y(v2) - zr_snapped_y(v0);
    return dx01 * dy20 - dx20 * dy01;
}

/* Returns the first pixel whose centre is at or after a snapped coordinate. Right shifts of negative numbers round
 * down, as on all supported compilers. */
static inline int32_t zr_viewport_first_centre(int32_t snapped)
{
    return (snapped + ZR_SUBPIXELS - 1) >> ZR_SUBPIXEL_BITS;
}

/* Returns the last pixel whose centre is at or before it. */
static inline int32_t zr_viewport_last_centre(int32_t snapped)
{
    return snapped >> ZR_SUBPIXEL_BITS;
}

struct zr_viewport zr_viewport_make(uint32_t width, uint32_t height);

/* Computes the window position of a vertex inside the view volume. Returns false if it has none (w = 0, overflow) and
 * must not be drawn. */
bool zr_viewport_apply(const struct zr_viewport *viewport, zr_vec4 clip, struct zr_window_vertex *out);

#endif
