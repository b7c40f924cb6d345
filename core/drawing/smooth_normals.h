/* smooth_normals.h - drawing: normals of small triangles, averaged with those around them.
 *
 * Space:  eye space.
 * Why:    scans have noise: each triangle of a few pixels has creases around it. Large triangles, as of CAD parts and
 *         cars, keep their normals, or lines of car bodies would be lost.
 * How:    a triangle with the trait ZR_TRIANGLE_SMALL, times its area, adds its small neighbours n across an edge of
 *         two triangles, times their areas and max(0, (cosine - 0.6) / 0.4), in two rounds.
 * Exact:  floats, in the order of sides. */
#ifndef ZR_SMOOTH_NORMALS_H
#define ZR_SMOOTH_NORMALS_H

#include "drawing/window_mesh.h"

/* Returns one unit normal per triangle, or 0. NULL if the arena failed. If cancelled, they are undefined. */
const float (*zr_smooth_normals_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                     const struct zr_window_mesh *mesh))[3];

#endif
