/* combined.h - measure: volume and centre of mass of combined solids (scene/csg.h).
 *
 * Rays:  as in measure/volumes.h: 256 along the longer side of the box, in three oblique directions. The length of a ray
 *        within the solid is that where the value of the tree is true.
 * Error: the spread of the directions, and a fiftieth of the changes between neighbouring rays: an estimate, as in
 *        mesh/facts/overlap.h.
 * Space: that of the file (measure/solid.h).
 * Exact: the same for all instruction sets and numbers of threads.
 */
#ifndef ZR_COMBINED_H
#define ZR_COMBINED_H

#include "base/run.h"
#include "base/status.h"
#include "mesh/world_place.h"
#include "scene/scene.h"

struct zr_combined {
    double volume, error;
    struct zr_world_place center; /* if the volume is not 0 */
};

/* Measures the solid of scene->csg in *out, in the arena. Takes scratch from the arena and gives it back. Fails with
 * ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_combined_find(const struct zr_run *run, const struct zr_scene *scene, const struct zr_combined **out);

#endif
