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

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum {
    ZR_CLIP_MAX = 16, /* 3 corners, and 1 more for each of 6 planes; the rest is for what rounding bends */
    ZR_CLIP_MADE = 6 * ZR_CLIP_MAX, /* on the way there, some of them cut off again */
    ZR_CLIP_VALUES = 3 + ZR_CLIP_MADE
};

/* Corners are numbered first, and then what is made of them, in order. */
struct zr_clip_vertex {
    zr_vec4 position;
    uint8_t id;
};

/* A vertex between two that there were before it: from + t (to - from), which is rule 3. */
struct zr_clip_made {
    uint8_t from, to;
    float t;
};

struct zr_clipped {
    int corners; /* that there were: 3, of a line 2 */
    int count;
    struct zr_clip_vertex vertices[ZR_CLIP_MAX]; /* that are left */
    int made_count;
    struct zr_clip_made made[ZR_CLIP_MADE];
};

/* One bit for each plane that `p` is outside of: +x, -x, +y, -y, near, far from
 * bit 0 up. NaN is outside of everything. */
unsigned zr_clip_outcode(zr_vec4 p);

/* Leaves the visible part of `tri` as a fan (v[i-1], v[i], v[0]), winding
 * kept, and returns its vertex count: 0, or 3..ZR_CLIP_MAX. `outcodes` is the OR of
 * the three corners' outcodes: only those planes cut. `edges` may be NULL; else it says which edges are left of the
 * triangle's own: bit i of *edges stands for the edge from corner i to the next one, before the call of `tri`, after it
 * of what is left. Edges along the planes have no bit.
 * Source: Sutherland & Hodgman, "Reentrant Polygon Clipping", 1974. */
int zr_clip_triangle(const zr_vec4 tri[3], unsigned outcodes, unsigned *edges, struct zr_clipped *out);

/* The visible part of the line from in[0] to in[1], direction kept; false where there is none,
 * or a distance is not finite. `outcodes` are those of the two ends. Each end outside is
 * computed once, from itself, for all planes together.
 * Source: Liang & Barsky, "A New Concept and Method for Line Clipping", 1984. */
bool zr_clip_line(const zr_vec4 in[2], const unsigned outcodes[2], struct zr_clipped *out);

/* Whatever varies over a triangle or a line is cut as its positions were: values[0] and so on are those of its corners,
 * and those of what was made are put behind them. */
void zr_clip_replay(const struct zr_clip_made *made, int made_count, int corners, zr_vec4 values[ZR_CLIP_VALUES]);

#endif
