/* varyings.h - shade: values that vary over a primitive, in groups, and their planes over the window.
 *
 * A set of groups is a mask of bits. A primitive's planes are 1/w, then those of the set's groups in this order, each
 * of a value times 1/w.
 */
#ifndef ZR_VARYINGS_H
#define ZR_VARYINGS_H

#include "raster/plane.h"
#include "shade/draw_attributes.h"

enum {
    ZR_VARY_COLOR = 1 << 0,     /* 3 planes; of the visible side */
    ZR_VARY_NORMAL = 1 << 1,    /* 3; of the visible side, in eye space */
    ZR_VARY_POINT = 1 << 2,     /* 3; ZR_ATTRIBUTE_POINT */
    ZR_VARY_DEPTH = 1 << 3,     /* 1; along the view axis, for fog */
    ZR_VARY_PLACE = 1 << 4,     /* 2; in the image of the base colour's texture */
    ZR_VARY_OPACITY = 1 << 5,   /* 1; of the visible side */
    ZR_VARY_TEXCOORDS = 1 << 6, /* 4; both coordinates as the mesh has them */
    ZR_VARY_TANGENT = 1 << 7,   /* 4; along u, of any length, then the sign of the bitangent, which is a constant */

    /* Only primitives whose pixels need them have the groups beside colour and opacity: those that are shaded late, or
     * that have textures, if the set has ZR_VARY_TEXCOORDS. */
    ZR_VARY_LATE = 1 << 8,
    /* Values that are the same all over a primitive have planes over w, too. Else their planes are constants, which are
     * not to be multiplied with w; 1/w is 1 then, if nothing else is in the set. */
    ZR_VARY_OVER_W = 1 << 9,

    ZR_PLANES_MOST = 14 /* of the largest set in use */
};

/* The number of the group's first plane. */
static inline int zr_first_plane(unsigned mask, unsigned group)
{
    const unsigned before = mask & (group - 1);
    return 1 + (before & ZR_VARY_COLOR ? 3 : 0) + (before & ZR_VARY_NORMAL ? 3 : 0) + (before & ZR_VARY_POINT ? 3 : 0) +
           (before & ZR_VARY_DEPTH ? 1 : 0) + (before & ZR_VARY_PLACE ? 2 : 0) + (before & ZR_VARY_OPACITY ? 1 : 0) +
           (before & ZR_VARY_TEXCOORDS ? 4 : 0) + (before & ZR_VARY_TANGENT ? 4 : 0);
}

static inline int zr_plane_count(unsigned mask)
{
    return zr_first_plane(mask, ZR_VARY_LATE);
}

/* Whether a primitive's colours may be constants beside groups that are over w: not those of phong alone, as bytes. */
static inline bool zr_mixes_constants(unsigned mask)
{
    return mask & ZR_VARY_LATE && mask & (ZR_VARY_DEPTH | ZR_VARY_PLACE | ZR_VARY_OPACITY);
}

/* Whether 1/w is 1 if the set's values are constants. */
static inline bool zr_may_lack_w(unsigned mask)
{
    return !(mask & (ZR_VARY_LATE | ZR_VARY_OVER_W));
}

/* ---- lines and points ---- */

/* True if primitive `number` has one colour all over: `color`, as bytes. */
bool zr_line_color(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface, uint32_t number,
                   uint32_t *color);

/* The set's planes, of which it has ZR_VARY_TEXCOORDS never: normals and places are 0. Returns whether colour and
 * opacity are constants. */
bool zr_line_planes(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface, uint32_t number,
                    unsigned mask, struct zr_plane planes[ZR_PLANES_MOST]);

#endif
