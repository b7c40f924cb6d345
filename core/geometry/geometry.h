/* geometry.h - geometry, the whole floor: polygons -> triangles in the window.
 *
 * Space:  window space (viewport.h), every triangle inside the view volume.
 * Order:  triangles keep the order of the polygons; of two at the same depth the
 *         earlier one is seen, so the order is part of the answer.
 */
#ifndef ZR_GEOMETRY_H
#define ZR_GEOMETRY_H

#include "base/team.h"
#include "geometry/counts.h"
#include "geometry/viewport.h"
#include "scene/camera.h"
#include "zraster.h"

/* Triangles, vertices and colours of a request: each fewer than this, so that four
 * entries a triangle (raster/bins.h) can be counted in 32 bits. */
#define ZR_GEOMETRY_MAX (UINT32_MAX / 4)

/* Oriented so that the reference's area (rule 6) is positive. */
struct zr_triangle {
    uint32_t v[3]; /* window vertices */
    uint32_t c[3]; /* colours; all three the same: flat */
    uint32_t face; /* the polygon's id: 1 + its number over all instances */
    uint32_t back; /* 1: seen from behind, so its colours are the back ones */
};

struct zr_geometry {
    uint32_t vertex_count, color_count, triangle_count;
    struct zr_window_vertex *vertices;
    zr_vec4 *front_colors, *back_colors;
    struct zr_triangle *triangles;
    struct zr_counts counts;
};

/* Everything points into the arena. ZR_NO_MEMORY or ZR_CANCELLED, else ZR_OK. */
enum zr_status zr_geometry_build(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                 const struct zr_camera *camera, const struct zr_cancel *cancel,
                                 struct zr_geometry *geometry);

#endif
