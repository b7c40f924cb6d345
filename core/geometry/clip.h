/* clip.h - geometry: cuts clip-space triangles and lines to the view volume.
 *
 * Space:  clip space, -w <= x,y,z <= w, before the perspective division.
 * Why:    attributes are linear in clip space only; cut after the division
 *         and they bend. A corner with w <= 0 has no window position at all.
 * Exact:  as llvmpipe does it, to the last bit (llvmpipe's rules 2, 3 and 13
 *         in tests/reference/RULES.md): float32, no guard band, planes in a fixed order.
 */
#ifndef ZR_CLIP_H
#define ZR_CLIP_H

#include "base/vec.h"

enum { ZR_CLIP_MAX = 16 }; /* 3 corners, and 1 more for each of 6 planes; the rest is for what rounding bends */

/* A corner and everything that is interpolated along with it. */
struct zr_clip_vertex {
    zr_vec4 position;
    zr_vec4 front, back; /* colours of the two sides */
    float eye_z, eye_w;  /* homogeneous eye-space depth */
};

/* One bit for each plane that `p` is outside of: +x, -x, +y, -y, near, far from
 * bit 0 up. NaN is outside of everything. */
unsigned zr_clip_outcode(zr_vec4 p);

/* Writes the visible part of `tri` to `out` as a fan (v[i-1], v[i], v[0]), winding
 * kept, and returns its vertex count: 0, or 3..ZR_CLIP_MAX. `outcodes` is the OR of
 * the three corners' outcodes: only those planes cut. `tri` and `out` must not overlap.
 * Source: Sutherland & Hodgman, "Reentrant Polygon Clipping", 1974. */
int zr_clip_triangle(const struct zr_clip_vertex tri[3], unsigned outcodes, struct zr_clip_vertex out[ZR_CLIP_MAX]);

/* The same, and says which edges are left of the triangle's own: bit i of *edges stands for
 * the edge from corner i to the next one, before the call of `tri`, after it of `out`.
 * Edges along the planes have no bit. */
int zr_clip_triangle_edges(const struct zr_clip_vertex tri[3], unsigned outcodes, unsigned *edges,
                           struct zr_clip_vertex out[ZR_CLIP_MAX]);

/* The visible part of the line from in[0] to in[1], direction kept; false where there is none,
 * or a distance is not finite. `outcodes` are those of the two ends. Each end outside is
 * computed once, from itself, for all planes together. `in` and `out` must not overlap.
 * Source: Liang & Barsky, "A New Concept and Method for Line Clipping", 1984. */
bool zr_clip_line(const struct zr_clip_vertex in[2], const unsigned outcodes[2], struct zr_clip_vertex out[2]);

#endif
