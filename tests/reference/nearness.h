/* nearness.h - reference: how near a pixel's sample lies to the edges of a face.
 *
 * Where two renderers disagree, the question is whether rounding can tell it. Faces are placed
 * and clipped here in double, on no grid, by code that shares nothing with either side.
 */
#ifndef ZR_TEST_NEARNESS_H
#define ZR_TEST_NEARNESS_H

#include <stdbool.h>
#include <stdint.h>

#include "core.h"
#include "scene/camera/camera.h"

struct near {
    double edge_px; /* to the nearest edge of its triangles, and of the pieces that clipping makes of them; HUGE_VAL:
                     * none in view */
    bool covered;   /* inside one of its triangles */
    double depth;   /* of the triangle that it is inside of, or nearest to */
    double slope;   /* of that depth, a pixel, in the steepest direction */
    double noise;   /* what rounding of corners to float may do to that depth */
};

/* A part of a face in the window: convex, x and y in pixels (y up), z as in the z-buffer. */
enum { NEARNESS_CORNERS_MAX = 9 };
struct nearness_piece {
    int count;
    bool edges_only; /* of the fan that parity counts: it has no depth of its own */
    double corners[NEARNESS_CORNERS_MAX][3];
};

/* Keeps the face that was asked for last. All zero but for the first four to begin with. */
struct nearness {
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    struct zr_arena *arena; /* for the triangles of faces that are not convex */
    double depth_rounding;  /* as nearness_rounding says; used by those who compare */
    uint32_t owner, count, room;
    struct nearness_piece *pieces;
};

/* Of face number `owner` (from 1, as in the face_id channel), at pixel x of row `row` from the top. */
struct near nearness_at(struct nearness *nearness, uint32_t owner, uint32_t x, uint32_t row);
/* What rounding in float may do to corners in view: to their place in pixels, and to their depth. For each the
 * sum of all magnitudes that are added up on the way to the window, and three roundings of it. */
struct rounding {
    double px, depth;
};
struct rounding nearness_rounding(const struct zr_scene *scene, const struct zr_camera *camera);

void nearness_free(struct nearness *nearness);

#endif
