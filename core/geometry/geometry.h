/* geometry.h - geometry: the draws and vertices of one view, made by build.h and constant afterwards.
 *
 * Space:  window space (viewport.h), everything inside the view volume. */
#ifndef ZR_GEOMETRY_H
#define ZR_GEOMETRY_H

#include <stdbool.h>
#include <stdint.h>

#include "base/matrix.h"
#include "core.h"
#include "geometry/counts.h"
#include "geometry/cut.h"
#include "geometry/draw.h"
#include "scene/camera/camera.h"

/* ---- transforms from object to clip and eye space in double, one set per instance ----
 *
 * Why:    window vertices are rounded to float, clipped ones more than once. A value that must be correct to the last
 *         bits of a float (shade/eye/eye_depth.h) is computed again from the mesh triangle (zr_source_of) that contains the
 *         primitive. */

/* Results of the transform: x, y, w of clip space, -z and w of eye space. */
enum { ZR_SOURCE_X, ZR_SOURCE_Y, ZR_SOURCE_W, ZR_SOURCE_EYE_DEPTH, ZR_SOURCE_EYE_W, ZR_SOURCE_ROWS };

struct zr_source_instance {
    uint32_t first_vertex;
    uint32_t vertex_count; /* of positions: all, or none of a mesh that is a cloud alone */
    const struct zr_mesh *mesh;
    double columns[4][ZR_SOURCE_ROWS]; /* matrix columns, of ZR_SOURCE_ROWS rows */
    struct zr_matrix object_to_eye;
    zr_mat4 to_eye, to_clip; /* in float, as used for vertices */
};

/* Multiplies the float matrices of scene and camera in double. */
struct zr_source_instance zr_source_instance_make(const struct zr_camera *camera, const zr_mat4 *object_to_world,
                                                  const struct zr_mesh *mesh, uint32_t first_vertex);

/* Limit of the primitives and vertices of a request, and of the corners of a mesh: kernels address four words of each
 * by 31 bits. */
#define ZR_GEOMETRY_MAX (1u << 28)

/* An edge on the snapped grid (viewport.h), y up, for the odd-even rule. */
struct zr_grid_edge {
    int32_t x0, y0, x1, y1; /* y0 < y1 */
};

/* Makes the edge between two points in either order. Returns false if it is horizontal: such an edge crosses no row of
 * samples, so the odd-even rule ignores it. */
static inline bool zr_grid_edge_make(int32_t ax, int32_t ay, int32_t bx, int32_t by, struct zr_grid_edge *edge)
{
    *edge = ay < by ? (struct zr_grid_edge){ax, ay, bx, by} : (struct zr_grid_edge){bx, by, ax, ay};
    return ay != by;
}

/* A polygon that is not convex. The odd-even rule over its edges decides coverage; its triangles only supply depth and
 * colour. They are consecutive primitives, and span several draws if the arrays of one draw (zr_placed) are full. */
struct zr_shape {
    uint32_t first_edge, edge_count;
    uint32_t triangle_count;            /* at least one */
    int32_t min_x, min_y, max_x, max_y; /* bounds of the edges, snapped */
};

/* Homogeneous eye-space depth, for the depth channel of lines and clipped primitives. */
struct zr_eye {
    float z, w;
};

struct zr_geometry {
    struct zr_window window;
    uint32_t vertex_count, primitive_count, shape_count, edge_count, draw_count, cut_count;
    struct zr_window_vertex *vertices; /* by instance: its `vertex_count`, then those created by clipping */
    struct zr_eye *eyes; /* one per vertex; defined for lines, points and vertices created by clipping only; NULL: there
                            are none of these */
    struct zr_draw *draws; /* ascending numbers; draws[0] always exists, empty if there are no draws */
    struct zr_shape *shapes;
    struct zr_grid_edge *edges;
    struct zr_cut *cuts;                  /* ascending first_vertex */
    struct zr_source_instance *instances; /* one per instance of the scene */
    struct zr_counts counts;              /* without draws that are not `counted` */
};

/* An end of a line, or a point. */
struct zr_wire_end {
    struct zr_window_vertex vertex;
    struct zr_eye eye;
};

/* Computes both ends of a line, which are equal for a point. Points of clouds must be in view. */
void zr_wire_ends(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number,
                  struct zr_wire_end ends[2]);

/* Returns the draw that contains primitive `number`. Takes logarithmic time in the number of draws. */
const struct zr_draw *zr_draw_of(const struct zr_geometry *geometry, uint32_t number);

/* Same, faster if the primitive is in the draw `last`. */
static inline const struct zr_draw *zr_draw_next(const struct zr_geometry *geometry, const struct zr_draw *last,
                                                 uint32_t number)
{
    return zr_draw_holds(last, number) ? last : zr_draw_of(geometry, number);
}

/* Returns a primitive of the draw, with its corners in the order of rule 6. Points of clouds have no corners. */
struct zr_triangle zr_triangle_of(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number);

/* The mesh triangle that a primitive shows in whole or in part. */
struct zr_source {
    const struct zr_source_instance *instance;
    const zr_vec4 *corners[3]; /* object space */
    bool is_cut;               /* the primitive is a piece of the triangle */
};

/* Returns the source of a triangle of the draw, given its window vertices. Takes logarithmic time in the number of
 * cuts. */
struct zr_source zr_source_of(const struct zr_geometry *geometry, const struct zr_draw *draw,
                              const uint32_t vertices[3]);

#endif
