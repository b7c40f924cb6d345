/* animation.h - scene: nodes that move with time.
 *
 * A track moves one node: through keys, which replace parts of the node's own pose, and by a turn about an axis through
 * the node's own origin, which comes first: matrix = pose * turn.
 * Exact:  matrices are computed in double by sums and products in a fixed order, with sines of base/trig.h. Keys and
 *         poses are rounded to float before, except those of a scene far from the origin. */
#ifndef ZR_ANIMATION_H
#define ZR_ANIMATION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/matrix.h"

struct zr_track {
    const char *node; /* its name */
    zr_vec3 axis;     /* of the turn, of any length */
    double degrees;   /* of the whole animation; 0: no turn */
    uint32_t key_count;
    const double *times;        /* seconds, ascending */
    const double *translations; /* 3 numbers per key; NULL: the node's own */
    const double *rotations;    /* 4 numbers per key: x, y, z, w */
    const double *scales;       /* 3 numbers per key */
    bool has_steps;             /* a key holds until the next one; false: poses between keys are interpolated */
};

struct zr_animation {
    uint32_t count;
    const struct zr_track *tracks; /* sorted by the names of nodes, which are unique */
};

/* A moment of an animation. */
struct zr_moment {
    double share;   /* of all frames, 0..1 */
    double seconds; /* since the first frame */
};

/* Pose of a node as the scene gives it. */
struct zr_node_pose {
    double translation[3], scale[3], rotation[4];
    bool is_exact; /* of a scene far from the origin: nothing is rounded to float before the matrix is made */
};

/* Returns a node's matrix to its parent. `own`: its pose, which only tracks with keys use; `local`: its matrix. Before
 * the first key and after the last one, the nearest key holds. */
struct zr_matrix zr_track_matrix(const struct zr_track *track, const struct zr_moment *moment,
                                 const struct zr_node_pose *own, const struct zr_matrix *local);

#endif
