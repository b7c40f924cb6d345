/* cost_pass.h - the core: what it takes to draw a scene once, in a window of some size, from a sample of its faces.
 *
 * Space:  triangles are placed, clipped and measured in the window just as for drawing;
 *         of a large scene a sample will do, one polygon out of each stretch of them, at a
 *         place that no regular pattern in the scene can keep to. The same scene gives
 *         the same cost.
 */
#ifndef ZR_COST_PASS_H
#define ZR_COST_PASS_H

#include "scene/camera.h"
#include "scene/scene.h"
#include "zraster.h"

/* In triangles, what is see-through: met twice more; in fragments, one of its pixels: kept,
 * sorted, shaded and blended. */
#define ZR_COST_LAYER_T 2.0
#define ZR_COST_LAYER_F 40.0

/* Where a scene is drawn, and how. */
struct zr_cost_target {
    uint32_t width, height;
    double line_width; /* pixels of it, 1 at least */
    double side;       /* how many times as large as their sizes points are */
};

/* How many faces, lines and points a scene has, and how many of them are looked at. */
struct zr_cost_sampling {
    uint64_t things, samples;
};

struct zr_cost_pass {
    double triangle_times; /* how many times longer the algorithm takes for a triangle; `cost` has it in it */
    struct zr_cost cost;   /* beside placing what there is: triangles, fragments, and those of shapes */
    double covered;        /* pixels of all faces, lines and points, hidden ones too */
    double layered;        /* of these, pixels of see-through faces: fragments that are kept */
    double masked;         /* of those, pixels of faces that have a mask */
    double faces;          /* that are seen, or hidden by others only */
    /* Of all faces, in the world, scene units squared, of each `surface_most` at most; of masked ones as often as each
     * of their pixels takes longer. */
    double surface;
};

/* `cancel` may be NULL; cancelled, it returns early with too little. */
struct zr_cost_pass zr_cost_pass_measure(const struct zr_scene *scene, const struct zr_camera *camera,
                                         struct zr_cost_target target, double surface_most,
                                         const struct zr_cancel *cancel, struct zr_cost_sampling sampling);

#endif
