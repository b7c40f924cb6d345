/* draw.h - geometry: runs of primitives of one kind, one instance and one material.
 *
 * Most are triangles of a mesh as it is: nothing is written for them, and a draw says where their corners stand. What
 * is more than that (pieces of clipped triangles, parts of shapes, lines) has arrays of its own, and is found in the
 * same way. Numbers keep the order of the scene, over all draws: of two primitives at the same depth the one with the
 * smaller number is seen.
 */
#ifndef ZR_DRAW_H
#define ZR_DRAW_H

#include <stddef.h>

#include "geometry/viewport.h"
#include "scene/scene.h"

enum zr_draw_kind {
    ZR_DRAW_TRIANGLES,
    ZR_DRAW_SHAPES,   /* triangles, each of them a part of a shape (geometry.h) */
    ZR_DRAW_OUTLINES, /* lines that are edges of faces */
    ZR_DRAW_LINES,    /* lines of the mesh */
    ZR_DRAW_POINTS    /* points of the mesh */
};

struct zr_draw {
    uint32_t first, count; /* numbers of its primitives */
    enum zr_draw_kind kind;
    bool depth_offset; /* moved back by a depth offset, so that outlines are seen on them */
    bool counted;      /* what becomes of them is counted (counts.h), and none of them is turned away or without area */
    bool mirrored;
    uint32_t instance;
    const struct zr_mesh *mesh;
    const struct zr_material *material;

    /* Three a primitive, counted from first_vertex: positions of the mesh, and behind them what clipping made. A line
     * has two, and the second once more; a point has one, three times. */
    const uint32_t *corners;
    /* Three a primitive: slots of mesh->indices, and behind them as many as clipping made. NULL: 3 first_face and those
     * that follow, as in a mesh of triangles. Of lines and points of the mesh they mean nothing. */
    const uint32_t *slots;
    /* One a primitive: faces of the mesh, behind them its lines, and then its points. NULL: first_face and those that
     * follow. */
    const uint32_t *faces;
    /* One a primitive: 2 times the number of its shape, and 1 more where it shows its back. NULL of
     * ZR_DRAW_TRIANGLES. */
    const uint32_t *traits;
    uint32_t first_face;
    uint32_t first_id; /* of face 0 */
    uint32_t first_vertex;
};

/* A primitive by itself, its corners turned as rule 6 wants them, so that its area is positive; a line or a point is
 * not. */
struct zr_triangle {
    uint32_t v[3];     /* window vertices */
    uint32_t shape;    /* 1 + the number of the shape that it is a part of; 0: it is seen wherever it covers a sample */
    bool line;         /* from v[0] to v[1]; a point is one that has no length (zr_draw.kind) */
    bool depth_offset; /* as in zr_draw */
    bool back;         /* seen from behind */
    bool turned;       /* corner 0 has changed places, by rule 6 (zr_swapped_corner) */
};

static inline bool zr_draw_is_of_lines(const struct zr_draw *draw)
{
    return draw->kind == ZR_DRAW_OUTLINES || draw->kind == ZR_DRAW_LINES;
}

/* Lines, or points: what has neither normals nor sides of its own. */
static inline bool zr_draw_is_of_wires(const struct zr_draw *draw)
{
    return zr_draw_is_of_lines(draw) || draw->kind == ZR_DRAW_POINTS;
}

/* All of its samples are kept, in lists (raster/fragments.h), not only the nearest ones. */
static inline bool zr_draw_is_see_through(const struct zr_draw *draw)
{
    return draw->material->alpha_mode != ZR_ALPHA_OPAQUE;
}

/* Triangles, and nothing more: those that can be looked at many at once. */
static inline bool zr_draw_is_plain(const struct zr_draw *draw)
{
    return draw->kind == ZR_DRAW_TRIANGLES && !draw->depth_offset;
}

/* Of primitive `t` of a draw, counted from its first. */
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

/* Id of the face, line or point that a primitive belongs to. */
static inline uint32_t zr_draw_id(const struct zr_draw *draw, uint32_t number)
{
    return draw->first_id + zr_draw_face(draw, number - draw->first);
}

#endif
