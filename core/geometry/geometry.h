/* geometry.h - geometry: what is drawn in the window, as build.h makes it; it never changes afterwards.
 *
 * Space:  window space (viewport.h), everything inside the view volume.
 */
#ifndef ZR_GEOMETRY_H
#define ZR_GEOMETRY_H

#include "geometry/counts.h"
#include "geometry/cut.h"
#include "geometry/draw.h"
#include "geometry/grid_edge.h"
#include "geometry/source.h"
#include "zraster.h"

/* Primitives and vertices of a request, and corners of a mesh: no more than this, so that kernels reach four words of
 * each by 31 bits. */
#define ZR_GEOMETRY_MAX (1u << 28)

/* A polygon that is no convex one. What it covers is decided by the odd-even rule over its edges; its
 * triangles, which are consecutive primitives (of more than one draw, where the room for one ends), only tell depth and
 * colour there. */
struct zr_shape {
    uint32_t first_edge, edge_count;
    uint32_t triangle_count;            /* at least one */
    int32_t min_x, min_y, max_x, max_y; /* of its edges */
};

/* Homogeneous eye-space depth, for the depth channel of lines and of what is clipped. */
struct zr_eye {
    float z, w;
};

struct zr_geometry {
    struct zr_window window;
    uint32_t vertex_count, primitive_count, shape_count, edge_count, draw_count, cut_count;
    struct zr_window_vertex *vertices; /* instance by instance: its mesh's positions, and what clipping made */
    struct zr_eye *eyes;   /* one a vertex; only those of lines, points and what clipping made are defined */
    struct zr_draw *draws; /* by their numbers; draws[0] is there even where there are none, and empty */
    struct zr_shape *shapes;
    struct zr_grid_edge *edges;
    struct zr_cut *cuts;                  /* by their vertices */
    struct zr_source_instance *instances; /* one an instance of the scene */
    struct zr_counts counts;              /* but of draws that are not `counted` */
};

/* The draw of a primitive. Takes the logarithm of their count. */
const struct zr_draw *zr_draw_of(const struct zr_geometry *geometry, uint32_t number);

/* The same where it is most often the draw of the primitive before. */
static inline const struct zr_draw *zr_draw_next(const struct zr_geometry *geometry, const struct zr_draw *last,
                                                 uint32_t number)
{
    return zr_draw_holds(last, number) ? last : zr_draw_of(geometry, number);
}

/* A primitive of the draw. */
struct zr_triangle zr_triangle_of(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number);

/* The triangle of a mesh that a primitive shows, or is a piece of. */
struct zr_source {
    const struct zr_source_instance *instance;
    const zr_vec4 *corners[3]; /* object space */
    bool is_cut;               /* the primitive is a piece of the triangle */
};

/* Of a triangle of the draw, by its window vertices. Takes the logarithm of how many primitives were cut. */
struct zr_source zr_source_of(const struct zr_geometry *geometry, const struct zr_draw *draw,
                              const uint32_t vertices[3]);

#endif
