/* shapes.h - input: bodies that a few numbers describe, as closed meshes.
 *
 * Space:  object space; the axis of round bodies and extrusions is z, and their middle the origin. Boxes lie around the
 *         origin. An extrusion has its points as given in x and y.
 * Faces:  counter-clockwise seen from outside. Round bodies have `segments` sides, whose corners lie on the body; one is
 *         at angle 0. A sphere has half as many rings, a torus as many around its tube as `segments` says.
 * Exact:  zr_sine_cosine, products and sums in double, rounded to float once. */
#ifndef ZR_SHAPES_H
#define ZR_SHAPES_H

#include "base/arena.h"
#include "scene/scene.h"

enum zr_shape_type {
    ZR_SHAPE_BOX,
    ZR_SHAPE_SPHERE,
    ZR_SHAPE_CYLINDER,
    ZR_SHAPE_CONE,
    ZR_SHAPE_TORUS,
    ZR_SHAPE_EXTRUSION,
    ZR_SHAPE_TYPES
};

enum { ZR_SHAPE_SEGMENTS_LEAST = 3, ZR_SHAPE_SEGMENTS_MAX = 512, ZR_SHAPE_POINTS_MAX = 1 << 16 };

struct zr_shape_desc {
    int type;            /* enum zr_shape_type; -1: not given */
    double size[3];      /* box: lengths along x, y, z */
    double radius;       /* sphere, cylinder, cone: at z = -height / 2; torus: of the circle inside its tube */
    double top;          /* cone: at z = height / 2; may be 0 */
    double tube;         /* torus: of its tube */
    double height;       /* cylinder, cone, extrusion */
    uint32_t segments;   /* around the axis */
    uint32_t count;      /* extrusion: corners of its polygon, which has an area */
    double (*points)[2]; /* in either direction */
    double move[3];      /* subtracted from all places */
};

/* Makes positions and faces of the mesh in the arena. False without memory. */
bool zr_shape_make(struct zr_arena *arena, const struct zr_shape_desc *shape, struct zr_mesh *mesh);

/* Returns twice the area of the polygon, negative if it is clockwise. */
double zr_shape_area(const struct zr_shape_desc *shape);

#endif
