/* draw.h - geometry: runs of primitives of one kind, one instance and one material.
 *
 * Most draws are unclipped triangles of a mesh: nothing is copied, the draw points to their corners. Pieces of clipped
 * triangles, parts of shapes, and lines have arrays of their own, with the same layout. A cloud is all points of a
 * mesh, with neither arrays nor window vertices. Primitive numbers follow the order of the scene over all draws: at
 * equal depths, the smaller number is visible. */
#ifndef ZR_DRAW_H
#define ZR_DRAW_H

#include <stddef.h>

#include "geometry/viewport.h"
#include "scene/scene.h"

enum zr_draw_kind {
    ZR_DRAW_TRIANGLES,
    ZR_DRAW_SHAPES,   /* triangles, each a part of a shape (geometry.h) */
    ZR_DRAW_OUTLINES, /* edges of faces */
    ZR_DRAW_LINES,    /* lines of the mesh */
    ZR_DRAW_POINTS    /* points of the mesh */
};

struct zr_draw {
    uint32_t first, count; /* range of primitive numbers */
    enum zr_draw_kind kind;
    bool depth_offset; /* moved back, so that outlines are visible on the faces */
    bool counted;      /* counts.h is final for these primitives, and all of them have an area and are not culled */
    bool mirrored;
    uint32_t instance;
    const struct zr_mesh *mesh;
    const struct zr_material *material;

    /* Three per primitive, relative to first_vertex: positions of the mesh, followed by vertices that clipping created.
     * A line has two, with the second repeated; a point has one, repeated twice. NULL for clouds. */
    const uint32_t *corners;
    /* Three per primitive: slots of mesh->indices, followed by one for each clipped vertex. NULL: consecutive from 3
     * first_face, as in a mesh of triangles. Undefined for lines and points of the mesh. */
    const uint32_t *slots;
    /* One per primitive: faces of the mesh, then its lines, then its points. NULL: consecutive from first_face. */
    const uint32_t *faces;
    /* One per primitive: 2 times the number of its shape, plus 1 if its back is visible. NULL for ZR_DRAW_TRIANGLES and
     * clouds. */
    const uint32_t *traits;
    uint32_t first_face;
    uint32_t first_id; /* id of face 0 */
    uint32_t first_vertex;
};

/* One primitive. A triangle's corners are ordered by rule 6, so that its area is positive. */
struct zr_triangle {
    uint32_t v[3];     /* window vertices */
    uint32_t shape;    /* 1 + the number of its shape; 0 if it is part of none and covers samples by itself */
    bool line;         /* from v[0] to v[1]; a point has no length (zr_draw.kind) */
    bool depth_offset; /* as in zr_draw */
    bool back;         /* its back is visible */
    bool turned;       /* corner 0 was swapped by rule 6 (zr_swapped_corner) */
};

static inline bool zr_draw_is_of_lines(const struct zr_draw *draw)
{
    return draw->kind == ZR_DRAW_OUTLINES || draw->kind == ZR_DRAW_LINES;
}

/* True for lines and points, which have neither normals nor sides of their own. */
static inline bool zr_draw_is_of_wires(const struct zr_draw *draw)
{
    return zr_draw_is_of_lines(draw) || draw->kind == ZR_DRAW_POINTS;
}

/* True for all points of a mesh, those outside the view included. Window vertices and eye depths are made for visible
 * points only, when they are needed (zr_wire_ends). */
static inline bool zr_draw_is_cloud(const struct zr_draw *draw)
{
    return draw->kind == ZR_DRAW_POINTS && !draw->counted;
}

/* Returns the position of point `number` of a cloud. */
static inline uint32_t zr_cloud_position(const struct zr_draw *draw, uint32_t number)
{
    return zr_mesh_point(draw->mesh, number - draw->first);
}

/* Returns the alpha mode of the material, or ZR_ALPHA_OPERAND for opaque faces of operands. */
static inline enum zr_alpha_mode zr_draw_mode(const struct zr_draw *draw)
{
    const struct zr_material *material = draw->material;
    const bool is_operand =
        material->is_operand && material->alpha_mode == ZR_ALPHA_OPAQUE && !zr_draw_is_of_wires(draw);
    return is_operand ? ZR_ALPHA_OPERAND : material->alpha_mode;
}

/* True if all fragments are kept in lists (raster/fragments.h), not only the nearest ones. */
static inline bool zr_draw_is_see_through(const struct zr_draw *draw)
{
    return zr_draw_mode(draw) != ZR_ALPHA_OPAQUE;
}

/* True for triangles that are neither parts of shapes nor offset in depth: the vector kernels process these in
 * groups. */
static inline bool zr_draw_is_plain(const struct zr_draw *draw)
{
    return draw->kind == ZR_DRAW_TRIANGLES && !draw->depth_offset;
}

/* Face, line or point of primitive `t`, counted from the draw's first. */
static inline uint32_t zr_draw_face(const struct zr_draw *draw, uint32_t t)
{
    return draw->faces ? draw->faces[t] : draw->first_face + t;
}

static inline uint32_t zr_draw_corner(const struct zr_draw *draw, uint32_t t, uint32_t k)
{
    return draw->corners[3 * (size_t)t + k];
}

static inline uint32_t zr_draw_slot(const struct zr_draw *draw, uint32_t t, uint32_t k)
{
    return draw->slots ? draw->slots[3 * (size_t)t + k] : 3 * (draw->first_face + t) + k;
}

static inline bool zr_draw_holds(const struct zr_draw *draw, uint32_t number)
{
    return number - draw->first < draw->count;
}

/* Returns the id of the primitive's face, line or point. */
static inline uint32_t zr_draw_id(const struct zr_draw *draw, uint32_t number)
{
    return draw->first_id + zr_draw_face(draw, number - draw->first);
}

#endif
