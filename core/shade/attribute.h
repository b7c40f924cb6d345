/* attribute.h - shade: per-primitive and per-vertex values of a draw: colours, normals and others. */
#ifndef ZR_ATTRIBUTE_H
#define ZR_ATTRIBUTE_H

#include "geometry/draw.h"

/* Number of values, and which of them a corner takes. */
enum zr_rate {
    ZR_RATE_DRAW,         /* one value */
    ZR_RATE_FACE,         /* one per face */
    ZR_RATE_FIRST_VERTEX, /* one per vertex; all corners of a face take that of its first */
    ZR_RATE_FIRST_CORNER, /* one per corner; all corners of a face take that of its first */
    ZR_RATE_VERTEX,
    ZR_RATE_CORNER
};

/* Vertices are counted from the instance's first, corners by their slots (draw.h). Values of clipped vertices
 * follow. */
struct zr_attribute {
    enum zr_rate rate;
    const zr_vec4 *values; /* NULL: none */
};

/* Returns true if all corners of a face have one value. */
static inline bool zr_rate_is_flat(enum zr_rate rate)
{
    return rate < ZR_RATE_VERTEX;
}

/* Returns the value number of corner `k` of primitive `t`, for a rate that is not flat. */
static inline uint32_t zr_smooth_number(const struct zr_draw *draw, enum zr_rate rate, uint32_t t, uint32_t k)
{
    return rate == ZR_RATE_VERTEX ? zr_draw_corner(draw, t, k) : zr_draw_slot(draw, t, k);
}

/* Returns the value number of primitive `t`, for a flat rate. */
static inline uint32_t zr_flat_number(const struct zr_draw *draw, enum zr_rate rate, uint32_t t)
{
    if (rate == ZR_RATE_DRAW) return 0;
    const uint32_t face = zr_draw_face(draw, t);
    if (rate == ZR_RATE_FACE) return face;
    const uint32_t slot = draw->mesh->face_offsets[face];
    return rate == ZR_RATE_FIRST_CORNER ? slot : draw->mesh->indices[slot];
}

#endif
