/* smooth_normal.h - lines: the normal of a small triangle, averaged with those around it.
 *
 * Space:  eye space.
 * Why:    scans have noise: each triangle of a few fine pixels (window_view.h) has creases around it. Large triangles, as of CAD parts and
 *         cars, keep their normals, or lines of car bodies would be lost.
 * How:    a triangle with the trait ZR_TRIANGLE_SMALL, times its area, adds its small neighbours n across an edge of
 *         two triangles, times their areas and max(0, (cosine - 0.6) / 0.4), in two rounds.
 * Exact:  floats, in the order of sides. */
#ifndef ZR_SMOOTH_NORMAL_H
#define ZR_SMOOTH_NORMAL_H

#include "lines/window_mesh.h"

/* Writes the unit normal of a triangle of the instance, or 0. Takes the time of five triangles. */
void zr_smooth_normal_of(const struct zr_window_mesh *mesh, const struct zr_drawn_instance *of, uint32_t triangle,
                         float out[3]);

#endif
