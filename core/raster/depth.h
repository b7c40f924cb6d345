/* depth.h - raster: depth of a primitive at each sample.
 *
 * Space:  window space; depth is that of the z-buffer, 0 (near) to 1 (far).
 * Exact:  the reference's rule 8: the plane of the unsnapped vertices; the offset of outlined faces is added after
 *         interpolation, and the sum is clamped. */
#ifndef ZR_DEPTH_H
#define ZR_DEPTH_H

#include "raster/depth_offset.h"
#include "raster/line.h"

struct zr_depth {
    struct zr_plane plane;
    float offset; /* depth offset of faces with outlines, else 0 */
};

static inline struct zr_depth zr_depth_make(const struct zr_window_vertex *vertices, const struct zr_triangle *triangle)
{
    const struct zr_window_vertex *v0 = &vertices[triangle->v[0]], *v1 = &vertices[triangle->v[1]],
                                  *v2 = &vertices[triangle->v[2]];
    struct zr_depth depth = {.offset = 0.0f};
    if (triangle->line) {
        struct zr_line_basis line = zr_line_basis_make(v0, v1);
        depth.plane = zr_line_plane_make(&line, v0->z, v1->z);
        return depth;
    }
    struct zr_plane_basis basis = zr_plane_basis_make(v0, v1, v2);
    depth.plane = zr_plane_make(&basis, v0->z, v1->z, v2->z);
    if (ZR_MUTANT(no_depth_offset, triangle->depth_offset, false))
        depth.offset = zr_depth_offset(v0, v1, v2, 1.0f, 1.0f);
    return depth;
}

/* Clamps to 1 first, NaN included, and then to 0. */
static inline float zr_depth_clamp(float z)
{
    z = z < 1.0f ? z : 1.0f;
    return ZR_MUTANT(depth_below_0, z > 0.0f, true) ? z : 0.0f;
}

static inline float zr_depth_at(const struct zr_depth *depth, int32_t x, int32_t y)
{
    return zr_depth_clamp(zr_plane_at(&depth->plane, (float)x, (float)y) + depth->offset);
}

#endif
