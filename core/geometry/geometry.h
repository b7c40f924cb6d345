/* geometry.h - geometry, the whole floor: polygons and lines -> what is drawn in the window.
 *
 * Space:  window space (viewport.h), everything inside the view volume.
 * Order:  records keep the order of the scene; of two at the same depth the
 *         earlier one is seen, so the order is part of the answer.
 */
#ifndef ZR_GEOMETRY_H
#define ZR_GEOMETRY_H

#include "base/team.h"
#include "geometry/counts.h"
#include "geometry/grid_edge.h"
#include "geometry/source.h"
#include "geometry/viewport.h"
#include "scene/camera.h"
#include "zraster.h"

/* Records, vertices and colours of a request: each no more than this, so that sums of some are within 32 bits. */
#define ZR_GEOMETRY_MAX (UINT32_MAX / 4)

/* Shapes of a request: fewer than this, so that a record's 29 bits number them. */
#define ZR_SHAPE_MASK (UINT32_MAX >> 3)

/* A record: one thing with one plane for each of its attributes, and one owner of pixels.
 * Most are triangles, oriented so that the reference's area (rule 6) is positive. */
struct zr_triangle {
    uint32_t v[3];       /* window vertices; of a line two, v[2] being v[1] again */
    uint32_t c[3];       /* colours; all three the same: flat */
    uint32_t face;       /* id of the polygon or line: 1 + its number over all instances */
    uint32_t back : 1;   /* seen from behind, so its colours are the back ones */
    uint32_t line : 1;   /* from v[0] to v[1], one pixel wide */
    uint32_t pushed : 1; /* moved back by a depth offset, so that outlines are seen on it */
    uint32_t shape : 29; /* 0: the triangle is seen wherever it covers a sample. Else 1 + the number
                          * of the shape that it is a part of */
};

/* A polygon that is no convex one. What it covers is decided by the odd-even rule over its edges; its
 * triangles, which are consecutive records, only tell depth and colour there. */
struct zr_shape {
    uint32_t first_edge, edge_count;
    uint32_t first_triangle, triangle_count; /* at least one */
    int32_t min_x, min_y, max_x, max_y;      /* of its edges */
};

struct zr_geometry {
    uint32_t vertex_count, color_count, triangle_count, shape_count, edge_count;
    struct zr_window_vertex *vertices;
    zr_vec4 *front_colors, *back_colors;
    struct zr_triangle *triangles;
    struct zr_shape *shapes;
    struct zr_grid_edge *edges;
    struct zr_sources sources; /* of the triangles */
    struct zr_counts counts;
};

/* Everything points into the arena. ZR_NO_MEMORY or ZR_CANCELLED, else ZR_OK. */
enum zr_status zr_geometry_build(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                 const struct zr_camera *camera, const struct zr_cancel *cancel,
                                 struct zr_geometry *geometry);

#endif
