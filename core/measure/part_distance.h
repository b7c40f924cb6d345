/* part_distance.h - measure: the least distance of two parts, and where it is.
 *
 * Space:  world space, in double precision.
 * How:    the triangles of each part in a tree of boxes (measure/surface_tree.h). Pairs of boxes are visited, those
 *         that are close first, and left out if they are farther apart than the least distance so far.
 * Cross:  parts cross if an edge of one leads through a triangle of the other one. Then the distance is 0, and the
 *         places are one on both. A part that lies wholly within a closed other one crosses it, too. Parts that only
 *         touch have the distance 0, and do not cross.
 * Work:   counted in steps: ZR_DISTANCE_STEPS for each triangle of both, and ZR_DISTANCE_STEPS_LEAST. Pairs that take
 *         more are left out.
 * Exact:  the same for all instruction sets and numbers of threads.
 */
#ifndef ZR_PART_DISTANCE_H
#define ZR_PART_DISTANCE_H

#include "base/run.h"
#include "base/status.h"
#include "scene/scene.h"

enum { ZR_DISTANCE_STEPS = 256, ZR_DISTANCE_STEPS_LEAST = 1 << 18 };

struct zr_part_distance {
    const char *parts[2];
    bool is_found; /* false: a part has no faces, or the pair takes too much work */
    bool crosses;
    double distance;
    double places[2][3]; /* on each part */
};

/* Measures the pairs of scene->distances, in the arena. Takes scratch from the arena and gives it back. Fails with
 * ZR_BAD_SCENE for an unknown name, with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_part_distances_find(const struct zr_run *run, const struct zr_scene *scene,
                                      const struct zr_part_distance **out);

#endif
