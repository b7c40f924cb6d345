/* geometry.h - geometry: what is drawn in the window, as build.h makes it.
 *
 * Space:  window space (viewport.h), everything inside the view volume.
 * Order:  records keep the order of the scene; of two at the same depth the
 *         earlier one is seen, so the order is part of the answer.
 */
#ifndef ZR_GEOMETRY_H
#define ZR_GEOMETRY_H

#include "geometry/batch.h"
#include "geometry/counts.h"
#include "geometry/grid_edge.h"
#include "geometry/light.h"
#include "geometry/source.h"
#include "scene/camera.h"
#include "zraster.h"

/* Records, vertices and colours of a request: each no more than this, so that sums of some are within 32 bits. */
#define ZR_GEOMETRY_MAX (UINT32_MAX / 4)

/* Shapes of a request: fewer than this, so that a record's 28 bits number them. */
#define ZR_SHAPE_MASK (UINT32_MAX >> 4)

/* A polygon that is no convex one. What it covers is decided by the odd-even rule over its edges; its
 * triangles, which are consecutive records, only tell depth and colour there. */
struct zr_shape {
    uint32_t first_edge, edge_count;
    uint32_t triangle_count;            /* at least one */
    int32_t min_x, min_y, max_x, max_y; /* of its edges */
};

/* Homogeneous eye-space depth, for the depth channel of lines and of what is clipped. */
struct zr_eye {
    float z, w;
};

/* What the normals of a record that is written out are, for the channel, and for what is shaded pixel by pixel. */
struct zr_written_surface {
    uint32_t n[3];                      /* into zr_geometry.normals; all three the same: flat */
    const struct zr_material *material; /* NULL: of a line */
};

struct zr_geometry {
    uint32_t vertex_count, color_count, normal_count, triangle_count, shape_count, edge_count, batch_count;
    struct zr_window_vertex *vertices;
    struct zr_eye *eyes; /* one a vertex; only those of lines and of what clipping made are defined */
    zr_vec4 *front_colors, *back_colors;
    zr_vec4 *points;  /* ways from the eye, one a vertex (zr_builder_point); NULL where nothing needs them */
    zr_vec4 *normals; /* of records that are written out, as of eye_normals.h; the first is 0 */
    struct zr_written_surface
        *surfaces; /* one a record that is written out; NULL as normals where nothing needs them */
    struct zr_lighting lighting;
    struct zr_batch *batches;      /* by their numbers; batches[0] is there even where there are none, and empty */
    struct zr_triangle *triangles; /* the records that are written out */
    struct zr_shape *shapes;
    struct zr_grid_edge *edges;
    struct zr_sources sources; /* of the triangles */
    struct zr_counts counts;
};

#endif
