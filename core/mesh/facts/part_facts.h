/* part_facts.h - mesh: measures of the parts of a scene (scene/parts/part_list.h).
 *
 * Space:  world space, in double precision. `box` contains faces; if the mesh is one part, also its lines and points.
 * How:    a face is the fan of each of its rings, from the ring's first corner. Holes count as negative. If a fan turns
 *         in both directions, such as a concave face, its area is the length of its area vector. The volume is a sum of
 *         pyramids over the fans (divergence theorem). Their apex is a corner of the part. The centre of mass is the
 *         mean of the pyramids' centroids, weighted by their volumes. What shells count more than once or against one
 *         another is measured along rays and taken off (mesh/facts/overlap.h).
 * Wall:   by mesh/facts/least_wall.h. The parts share ZR_WALL_STEPS_MIN steps, and ZR_WALL_STEPS for each of their
 * triangles.
 * Work:   limits keep it within ten times of what core/cost predicts by the number of parts and triangles
 *         (make bench-costs-hostile). Walls of usual parts take up to 220 steps for each triangle.
 * Lost:   a face with a corner beyond the range of float has no area. A part with such a face is not closed.
 * Exact:  each task of ZR_FACES_PER_TASK faces has separate sums, which are added in order. The results are therefore
 *         the same for all numbers of threads and instruction sets.
 */
#ifndef ZR_PART_FACTS_H
#define ZR_PART_FACTS_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "mesh/facts/least_wall.h"
#include "mesh/facts/shells.h"
#include "scene/parts/part_list.h"

enum { ZR_FACES_PER_TASK = 4096 };

/* Steps of the search for least walls (mesh/facts/least_wall.h): for all parts together, and for each of their
 * triangles. */
enum { ZR_WALL_STEPS_MIN = 1 << 17, ZR_WALL_STEPS = 192 };

/* Work of grids of rays (mesh/facts/overlap.h): a sum that all parts share, the least work per part, and the work that
 * each triangle adds. */
enum { ZR_OVERLAP_WORK = 9 << 14, ZR_OVERLAP_WORK_LEAST = 1 << 12, ZR_OVERLAP_WORK_OF_TRIANGLE = 24 };

/* Edges of a part that is not closed, and the middle of one, in world space. */
struct zr_edge_facts {
    uint32_t count;
    double at[3];
};

struct zr_part_facts {
    bool is_hidden; /* nothing of it is drawn */
    bool has_box;   /* false: no face, line or point */
    zr_vec3 min, max;
    uint64_t triangles; /* sum over its faces: corners - 2, plus 2 per hole */
    double area;
    bool is_closed;                                 /* by the rule of mesh/facts/closed_parts.h */
    struct zr_shells shells;                        /* open if a face has a corner beyond the range of float */
    struct zr_edge_facts open_edges, flipped_edges; /* shells.h */
    double volume;                                  /* if closed; negative if all its faces are turned inside out */
    bool has_overlap;    /* its shells overlap or are turned against one another: the volume is that of rays */
    double volume_error; /* then */
    bool has_center;
    double center[3];                /* centre of mass of the volume, if closed and the volume is not 0 */
    struct zr_least_wall least_wall; /* of a closed part whose volume is not 0 */
    zr_vec3 color; /* mean base colour by area, without textures, sRGB-encoded; without area, mean over faces, or over
                      lines and points */
};

/* Fills in facts[0 .. parts->count - 1]. Leaves up to 4 bytes per face, and one task per ZR_FACES_PER_TASK faces, in
 * the arena. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_part_facts_find(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_part_list *parts, struct zr_part_facts *facts);

#endif
