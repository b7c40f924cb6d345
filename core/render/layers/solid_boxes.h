/* solid_boxes.h - render: boxes of the parts of combined solids (scene/csg.h) in the window.
 *
 * Why:    most tiles have faces of one part only, or of tools alone: they need no lists of fragments. The bunny without
 *         three spheres takes half of the time. */
#ifndef ZR_SOLID_BOXES_H
#define ZR_SOLID_BOXES_H

#include "base/run.h"
#include "geometry/geometry.h"
#include "raster/tile.h"
#include "scene/csg.h"

struct zr_solid_boxes {
    uint32_t count; /* parts */
    float min_x[ZR_CSG_PARTS_MAX], min_y[ZR_CSG_PARTS_MAX], max_x[ZR_CSG_PARTS_MAX],
        max_y[ZR_CSG_PARTS_MAX]; /* pixels, y up */
};

/* Makes the boxes of the drawn faces in the arena. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_solid_boxes_make(const struct zr_run *run, const struct zr_csg *csg,
                                   const struct zr_geometry *geometry, const struct zr_solid_boxes **out);

/* Returns the parts, one bit each, whose boxes overlap a placed tile. */
uint64_t zr_solid_boxes_at(const struct zr_solid_boxes *boxes, const struct zr_tile *tile);

#endif
