/* attribute.h - shade: values that vary over what is drawn: colours, normals, whatever comes next. */
#ifndef ZR_ATTRIBUTE_H
#define ZR_ATTRIBUTE_H

#include "geometry/draw.h"

/* How many values there are, and which of them a corner has. */
enum zr_rate {
    ZR_RATE_DRAW,         /* one */
    ZR_RATE_FACE,         /* one a face */
    ZR_RATE_FIRST_VERTEX, /* one a vertex: all corners have that of the face's first one */
    ZR_RATE_FIRST_CORNER, /* one a corner, the same */
    ZR_RATE_VERTEX,
    ZR_RATE_CORNER
};

/* Vertices are counted from the instance's first, corners by their slots (draw.h): what clipping made follows behind.
 */
struct zr_attribute {
    enum zr_rate rate;
    const zr_vec4 *values; /* NULL: there are none */
};

/* The same for all corners of a face. */
static inline bool zr_rate_is_flat(enum zr_rate rate)
{
    return rate < ZR_RATE_VERTEX;
}

/* Which value corner `k` of primitive `t` of a draw has, of one that is not flat. */
static inline uint32_t zr_smooth_number(const struct zr_draw *draw, enum zr_rate rate, uint32_t t, uint32_t k)
{
    return rate == ZR_RATE_VERTEX ? zr_draw_corner(draw, t, k) : zr_draw_slot(draw, t, k);
}

/* Which value all corners have, of one that is flat. */
static inline uint32_t zr_flat_number(const struct zr_draw *draw, enum zr_rate rate, uint32_t t)
{
    if (rate == ZR_RATE_DRAW) return 0;
    const uint32_t face = zr_draw_face(draw, t);
    if (rate == ZR_RATE_FACE) return face;
    const uint32_t slot = draw->mesh->face_offsets[face];
    return rate == ZR_RATE_FIRST_CORNER ? slot : draw->mesh->indices[slot];
}

#endif
