/* recenter.h - input: meshes far from the origin, such as surveys in metres. Subtracts their middle in double precision,
 * before positions are rounded to float.
 *
 *     read all positions; note whether one is beyond limits->coordinate_max, and refuse those beyond zr_recenter_limit
 *     if one is: read again, zr_box_include for each position that is drawn
 *                zr_recenter_origin(&box, limits, origin), then read again, subtract origin before rounding, and set
 *                scene->origin
 *
 * A mesh within the limit is moved, too, if it is remote: its middle is farther from the origin than ZR_FAR_SIZES times
 * its largest side, so that floats, and places computed from them, lose digits that its size needs. That origin is
 * rounded to float, so that matrices of floats may add it again. Any other mesh keeps its coordinates: its origin is
 * NULL.
 */
#ifndef ZR_RECENTER_H
#define ZR_RECENTER_H

#include <math.h>
#include <stdbool.h>

#include "base/arena.h"
#include "base/matrix.h"
#include "base/run.h"
#include "base/status.h"
#include "base/vec.h"
#include "core.h"

/* Bounds in double precision. */
struct zr_box {
    double low[3], high[3];
};

/* Returns a box that contains no position. */
static inline struct zr_box zr_box_empty(void)
{
    return (struct zr_box){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}

static inline void zr_box_include(struct zr_box *box, const double position[3])
{
    for (int axis = 0; axis < 3; axis++) {
        if (position[axis] < box->low[axis]) box->low[axis] = position[axis];
        if (position[axis] > box->high[axis]) box->high[axis] = position[axis];
    }
}

static inline void zr_box_join(struct zr_box *box, const struct zr_box *other)
{
    for (int axis = 0; axis < 3; axis++) {
        if (other->low[axis] < box->low[axis]) box->low[axis] = other->low[axis];
        if (other->high[axis] > box->high[axis]) box->high[axis] = other->high[axis];
    }
}

enum { ZR_FAR_SIZES = 1000 };

/* True if the middle of the box is farther from the origin, along an axis, than so many times the largest side. Every
 * part of a remote mesh with a size is remote by nearly as much. */
bool zr_box_is_remote(const struct zr_box *box, double sizes);

/* True if all positions together are remote. */
bool zr_recenter_is_remote(const zr_vec4 *positions, size_t count);

/* Returns the position minus the origin. `origin` may be NULL. */
static inline zr_vec4 zr_recenter_position(const double v[3], const double *origin)
{
    if (!origin) return (zr_vec4){(float)v[0], (float)v[1], (float)v[2], 1};
    return (zr_vec4){(float)(v[0] - origin[0]), (float)(v[1] - origin[1]), (float)(v[2] - origin[2]), 1};
}

/* Adds the corners of `box`, placed by the matrix, to `all`. */
void zr_box_include_placed(struct zr_box *all, const struct zr_box *box, const struct zr_matrix *matrix);

/* Offsets of a scene in JSON that is far from the origin. They are subtracted from its doubles. Such a scene is read
 * twice: the first time to find them. They are floats; (0, 0, 0) is none. */
struct zr_far {
    uint32_t mesh_count;
    const double (*moves)[3]; /* from positions, which nodes may place: per mesh of the list, then of the polygons */
    double origin[3];         /* from places in world space: the scene's new origin */
};

/* Returns the offset of a mesh's positions. A number beyond the list of meshes stands for the polygons. */
static inline const double *zr_far_move(const struct zr_far *far, size_t mesh)
{
    return far->moves[mesh < far->mesh_count ? mesh : far->mesh_count];
}

/* True if the numbers are not (0, 0, 0). */
static inline bool zr_far_moves(const double by[3])
{
    return by[0] != 0.0 || by[1] != 0.0 || by[2] != 0.0;
}

/* Returns a homogeneous position minus the move. */
static inline zr_vec4 zr_far_position(const double move[3], const double v[3], double w)
{
    return (zr_vec4){(float)(v[0] - move[0] * w), (float)(v[1] - move[1] * w), (float)(v[2] - move[2] * w), (float)w};
}

/* Returns a place in world space minus the origin of `far`, which may be NULL. */
static inline zr_vec3 zr_far_place(const struct zr_far *far, const double v[3])
{
    const zr_vec4 at = zr_recenter_position(v, far ? far->origin : NULL);
    return (zr_vec3){at.x, at.y, at.z};
}

/* Largest magnitude of a coordinate before its origin is subtracted. */
static inline double zr_recenter_limit(const struct zr_limits *limits)
{
    return (double)limits->coordinate_max * 1e9;
}

/* Sets *origin to the middle of the box: three numbers in the arena. Sets it to NULL if the box is empty, or within
 * coordinate_max and not remote, or if the arena failed. Refuses a box whose half extent exceeds ZR_FAR_HALF_EXTENTS times
 * coordinate_max. */
enum { ZR_FAR_HALF_EXTENTS = 1000 };
enum zr_status zr_recenter_origin(struct zr_arena *arena, const struct zr_box *box, const struct zr_limits *limits,
                                  const double **origin, struct zr_error *error);

/* Finds and subtracts the origin of `count` positions that are floats in the file. All of them are drawn. */
enum zr_status zr_recenter_shift(const struct zr_run *run, const struct zr_limits *limits, zr_vec4 *positions,
                                 size_t count, const double **origin);

#endif
