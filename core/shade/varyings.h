/* varyings.h - shade: interpolants of a primitive, in groups, and their planes over the window.
 *
 * A set of groups is a bit mask. A primitive's planes are 1/w, then those of the set's groups in this order, each of a
 * value times 1/w.
 */
#ifndef ZR_VARYINGS_H
#define ZR_VARYINGS_H

#include "raster/plane.h"
#include "shade/draw_attributes.h"

enum {
    ZR_VARY_COLOR = 1 << 0,     /* 3 planes; visible side */
    ZR_VARY_NORMAL = 1 << 1,    /* 3; visible side, eye space */
    ZR_VARY_POINT = 1 << 2,     /* 3; ZR_ATTRIBUTE_POINT */
    ZR_VARY_DEPTH = 1 << 3,     /* 1; along the view axis, for fog */
    ZR_VARY_PLACE = 1 << 4,     /* 2; coordinates in the base colour's texture */
    ZR_VARY_OPACITY = 1 << 5,   /* 1; visible side */
    ZR_VARY_TEXCOORDS = 1 << 6, /* 4; both coordinate sets of the mesh */
    ZR_VARY_TANGENT = 1 << 7,   /* 4; tangent along u, of any length, and the bitangent's sign, a constant */

    /* Groups other than colour and opacity are made only for primitives that need them: those shaded per pixel, or,
     * with ZR_VARY_TEXCOORDS, those with textures. */
    ZR_VARY_PER_PIXEL = 1 << 8,
    /* Constant values get planes over w, too. Otherwise their planes are constants, not to be multiplied with w; 1/w is
     * then 1 if the set has no other groups. */
    ZR_VARY_OVER_W = 1 << 9,

    ZR_PLANES_MOST = 14 /* planes of the largest set in use */
};

/* Returns the number of the group's first plane. */
static inline int zr_first_plane(unsigned mask, unsigned group)
{
    const unsigned before = mask & (group - 1);
    return 1 + (before & ZR_VARY_COLOR ? 3 : 0) + (before & ZR_VARY_NORMAL ? 3 : 0) + (before & ZR_VARY_POINT ? 3 : 0) +
           (before & ZR_VARY_DEPTH ? 1 : 0) + (before & ZR_VARY_PLACE ? 2 : 0) + (before & ZR_VARY_OPACITY ? 1 : 0) +
           (before & ZR_VARY_TEXCOORDS ? 4 : 0) + (before & ZR_VARY_TANGENT ? 4 : 0);
}

static inline int zr_plane_count(unsigned mask)
{
    return zr_first_plane(mask, ZR_VARY_PER_PIXEL);
}

/* Returns true if colours may be constants beside groups over w. Sets of phong alone, which end as bytes, are
 * excluded. */
static inline bool zr_mixes_constants(unsigned mask)
{
    return mask & ZR_VARY_PER_PIXEL && mask & (ZR_VARY_DEPTH | ZR_VARY_PLACE | ZR_VARY_OPACITY);
}

/* Returns true if 1/w is 1 for sets of constant values. */
static inline bool zr_may_lack_w(unsigned mask)
{
    return !(mask & (ZR_VARY_PER_PIXEL | ZR_VARY_OVER_W));
}

/* ---- lines and points ---- */

/* Returns true if primitive `number` has one constant colour, and writes it to `color`, as bytes. */
bool zr_line_color(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, uint32_t number,
                   uint32_t *color);

/* Makes the set's planes. The set lacks ZR_VARY_TEXCOORDS; normals and texture places are 0. Returns true if colour and
 * opacity are constants. */
bool zr_line_planes(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, uint32_t number,
                    unsigned mask, struct zr_plane planes[ZR_PLANES_MOST]);

#endif
