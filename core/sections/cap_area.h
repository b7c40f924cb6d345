/* cap_area.h - sections: the area of a cap, as it is drawn.
 *
 * Space:  world space, in double precision.
 * Rule:   what lies where the winding number of the rings is not 0 counts, once. If no place has a winding number beyond
 *         1, and all have the same sign, that is the length of the sum of the rings' area vectors. Otherwise, what this
 *         sum counts too often or against one another is measured along rows, and taken off.
 * Rows:   ZR_CAP_ROWS across the cap, oblique to its axes; each is exact. They become fewer until they cross at most
 *         ZR_CAP_WORK edges, and ZR_CAP_WORK_OF_CORNER per corner of the cap. */
#ifndef ZR_CAP_AREA_H
#define ZR_CAP_AREA_H

#include "base/run.h"
#include "scene/scene.h"

enum { ZR_CAP_ROWS = 1 << 11, ZR_CAP_WORK = 1 << 20, ZR_CAP_WORK_OF_CORNER = 16 };

/* Finds the area of a cap of a mesh, counted from its first cap. Takes scratch from the run's arena and gives it back.
 * False without memory, or if cancelled. */
bool zr_cap_area_find(const struct zr_run *run, const struct zr_mesh *mesh, uint32_t cap,
                      const zr_mat4 *object_to_world, double *area);

#endif
