/* part_holes.h - drawing: the holes of all parts, as one list.
 *
 * Space:  world space. Holes are those of mesh/features/holes.h of parts that are drawn. */
#ifndef ZR_PART_HOLES_H
#define ZR_PART_HOLES_H

#include "base/run.h"
#include "base/status.h"
#include "base/warning_list.h"
#include "mesh/features/holes.h"
#include "scene/scene.h"

enum { ZR_PART_HOLES_MAX = 512 };

struct zr_part_hole {
    struct zr_hole hole;
    zr_dvec3 ends[2]; /* of the axis: entry and far end, with all steps */
    double radius;    /* largest, with all steps */
};

struct zr_part_holes {
    uint32_t count;
    struct zr_part_hole *at;
};

/* Finds them, in run->arena; warns of those that are left out. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_part_holes_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_part_holes *out,
                                  struct zr_arena *texts, struct zr_warning_list *warnings);

#endif
