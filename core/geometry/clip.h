/* clip.h - geometry: clips clip-space triangles and lines to the view volume.
 *
 * Space:  clip space, -w <= x,y,z <= w, before the perspective division.
 * Why:    attributes are linear in clip space, and no longer after the division. A corner with w <= 0 has no window
 *         position at all.
 * Exact:  equal to llvmpipe to the last bit (llvmpipe's rules 2, 3 and 13 in tests/reference/RULES.md): float32, no
 *         guard band, planes in a fixed order. */
#ifndef ZR_CLIP_H
#define ZR_CLIP_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum {
    ZR_CLIP_MAX = 16,               /* 3 corners, and 1 more for each of 6 planes; the rest allows for rounding */
    ZR_CLIP_MADE = 6 * ZR_CLIP_MAX, /* vertices created on the way, some of them cut off again */
    ZR_CLIP_VALUES = 3 + ZR_CLIP_MADE
};

/* Corners have the ids 0, 1 and 2; created vertices continue the numbering in the order of their creation. */
struct zr_clip_vertex {
    zr_vec4 position;
    uint8_t id;
};

/* A vertex created between two earlier ones: from + t (to - from), which is rule 3. */
struct zr_clip_made {
    uint8_t from, to;
    float t;
};

struct zr_clipped {
    int corners; /* corners of the input: 3, or 2 for a line */
    int count;
    struct zr_clip_vertex vertices[ZR_CLIP_MAX]; /* of the clipped primitive */
    int made_count;
    struct zr_clip_made made[ZR_CLIP_MADE];
};

/* Returns one bit for each plane that `p` is outside of: +x, -x, +y, -y, near, far from bit 0 up. NaN is outside of all
 * planes. */
unsigned zr_clip_outcode(zr_vec4 p);

/* Writes the visible part of `tri` to `out` as a fan (v[i-1], v[i], v[0]), winding kept, and returns its vertex count:
 * 0, or 3..ZR_CLIP_MAX. `outcodes` is the OR of the corners' outcodes: only those planes cut. `edges`, which may be
 * NULL, marks the triangle's own edges: bit i is the edge from vertex i to the next one, of `tri` on entry and of the
 * result on return. Edges that lie in a clip plane have no bit.
 * Source: Sutherland & Hodgman, "Reentrant Polygon Clipping", 1974. */
int zr_clip_triangle(const zr_vec4 tri[3], unsigned outcodes, unsigned *edges, struct zr_clipped *out);

/* Writes the visible part of the line from in[0] to in[1], direction kept. Returns false if nothing is visible or a
 * distance is not finite. `outcodes` are those of the two ends. Each clipped end is computed once, from the original
 * end, for all planes together.
 * Source: Liang & Barsky, "A New Concept and Method for Line Clipping", 1984. */
bool zr_clip_line(const zr_vec4 in[2], const unsigned outcodes[2], struct zr_clipped *out);

/* Clips attribute values like the positions: reads the corners' values from values[0] on and appends those of the
 * created vertices. */
void zr_clip_replay(const struct zr_clip_made *made, int made_count, int corners, zr_vec4 values[ZR_CLIP_VALUES]);

#endif
