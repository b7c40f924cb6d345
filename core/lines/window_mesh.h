/* window_mesh.h - lines: all triangles of a scene in the window, with their edges.
 *
 * Space:  window_view.h; normals and areas in eye space.
 * In:     the scene's instances, and the edge table of each mesh (mesh/edge_mesh.h).
 * How:    vertices and triangles of all instances are numbered through. A triangle that crosses the near or far plane
 *         is cut; its pieces hide lines, and are numbered behind the triangles.
 * Exact:  the same for any number of threads. */
#ifndef ZR_WINDOW_MESH_H
#define ZR_WINDOW_MESH_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "lines/window_view.h"
#include "mesh/edge_mesh.h"

struct zr_drawn_instance {
    const struct zr_edge_mesh *table;
    const struct zr_mesh *mesh;
    uint32_t first_vertex, first_triangle, first_edge, first_piece;
    struct zr_matrix to_eye, to_clip;
    bool is_mirror; /* the transform to eye space is a reflection */
};

/* Traits of a triangle. */
enum {
    ZR_TRIANGLE_FRONT = 1,  /* its plane faces the eye: it is counter-clockwise for the eye */
    ZR_TRIANGLE_ABSENT = 2, /* culled or not filled: it makes and hides no lines */
    ZR_TRIANGLE_HIDES = 4,  /* it covers an area of the window with a margin, and no line behind it is visible */
    ZR_TRIANGLE_SMALL = 8   /* smaller than ZR_SMALL_PIXELS in both directions */
};

enum { ZR_SMALL_PIXELS = 20, ZR_WINDOW_MARGIN = 64 /* pixels around the window, where lines are found as well */ };

struct zr_window_mesh {
    struct zr_window_view view;
    uint32_t instance_count, vertex_count, triangle_count, edge_count, piece_count;
    uint32_t cut_count; /* pieces of cut triangles */
    const struct zr_drawn_instance *instances;
    const struct zr_window_point *points; /* vertices, then corners of cut pieces; undefined if outside */
    const double (*eyes)[3];              /* by vertex: its place in eye space */
    const uint8_t *outside;               /* by vertex: ZR_OUTSIDE bits */
    const float (*normals)[3];            /* by triangle: unit normal, 0 without area */
    const float *areas;                   /* by triangle: twice its area */
    const uint32_t (*corners)[3];         /* by triangle and cut piece: points, counter-clockwise in the window */
    const uint8_t *traits;                /* by triangle and cut piece */
    const uint32_t *sources;              /* by cut piece: its triangle */
};

/* Makes the arrays. `tables` has one edge table per mesh. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_window_mesh_make(const struct zr_run *run, const struct zr_scene *scene,
                                   const struct zr_edge_mesh *tables, const struct zr_window_view *view,
                                   struct zr_window_mesh *out);

/* Returns the instance of a triangle, an edge or a vertex by the number of its first one. `offset` is the offset of
 * that member in struct zr_drawn_instance. Takes logarithmic time. */
uint32_t zr_drawn_instance_of(const struct zr_window_mesh *mesh, size_t offset, uint32_t number);

/* Returns the triangle of a triangle or cut piece. */
static inline uint32_t zr_hider_source(const struct zr_window_mesh *mesh, uint32_t hider)
{
    return hider < mesh->triangle_count ? hider : mesh->sources[hider - mesh->triangle_count];
}

/* Returns the connected piece of a triangle, numbered through all instances. */
uint32_t zr_drawn_piece_of(const struct zr_window_mesh *mesh, uint32_t triangle);

#endif
