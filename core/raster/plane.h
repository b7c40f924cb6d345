/* plane.h - raster: a value that varies linearly over the window.
 *
 * Space:  window space, from unsnapped vertices: here of an oriented triangle, in line.h of a line.
 * Exact:  the reference's rule 8. z, 1/w and every attribute times 1/w are such planes. */
#ifndef ZR_PLANE_H
#define ZR_PLANE_H

#include "geometry/geometry.h"

/* Common terms of all planes of one triangle. */
struct zr_plane_basis {
    float dx01, dy01, dx20, dy20; /* edge vectors over the area */
    float x0, y0;                 /* vertex 0, relative to the centre of pixel (0, 0) */
};

struct zr_plane {
    float a0, dadx, dady;
};

/* Returns a window coordinate relative to the centre of pixel (0, 0), unsnapped. */
static inline float zr_from_centre(float window)
{
    return ZR_MUTANT(planes_from_the_grid, window - 0.5f, zr_viewport_snap(window) * (1.0f / ZR_SUBPIXELS));
}

static inline struct zr_plane_basis zr_plane_basis_make(const struct zr_window_vertex *v0,
                                                        const struct zr_window_vertex *v1,
                                                        const struct zr_window_vertex *v2)
{
    float dx01 = v0->x - v1->x, dy01 = v0->y - v1->y, dx20 = v2->x - v0->x, dy20 = v2->y - v0->y;
    float ooa = 1.0f / (dx01 * dy20 - dy01 * dx20);
    return (struct zr_plane_basis){dx01 * ooa,           dy01 * ooa, dx20 * ooa, dy20 * ooa, zr_from_centre(v0->x),
                                   zr_from_centre(v0->y)};
}

/* Returns the plane with the values p0, p1, p2 at the three vertices. */
static inline struct zr_plane zr_plane_make(const struct zr_plane_basis *basis, float p0, float p1, float p2)
{
    float d01 = p0 - p1, d20 = p2 - p0;
    float dadx = d01 * basis->dy20 - d20 * basis->dy01;
    float dady = d20 * basis->dx01 - d01 * basis->dx20;
    return (struct zr_plane){p0 - (dadx * basis->x0 + dady * basis->y0), dadx, dady};
}

/* Returns the value at the centre of pixel (x, y). */
static inline float zr_plane_at(const struct zr_plane *plane, float x, float y)
{
    return (plane->a0 + plane->dadx * x) + plane->dady * y;
}

#endif
