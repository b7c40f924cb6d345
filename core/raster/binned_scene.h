/* binned_scene.h - raster: production's visibility: primitives are binned by tile, and each tile is drawn by
 * half-spaces.
 *
 * Blocks of a tile may stay unwritten (zr_tile.unwritten).
 */
#ifndef ZR_BINNED_SCENE_H
#define ZR_BINNED_SCENE_H

#include "base/run.h"
#include "raster/bins.h"
#include "raster/cloud_bins.h"
#include "raster/halfspace.h"
#include "raster/misc_bins.h"
#include "raster/small.h"
#include "raster/visibility.h"

/* Primitives of one alpha mode, binned by tile. */
struct zr_mode_bins {
    struct zr_bins bins;
    struct zr_misc_bins misc;
    struct zr_cloud_bins clouds;
};

/* The geometry of a window, binned by alpha mode and tile. */
struct zr_binned_scene {
    struct zr_visibility visibility;
    const struct zr_geometry *geometry;
    const struct zr_prepaint *prepaints; /* one per draw, or NULL */
    const struct zr_base *base;          /* or NULL */
    const struct zr_halfspace *halfspace;
    zr_small_fn *draw_small;
    uint32_t width, height;
    struct zr_mode_bins modes[ZR_ALPHA_COUNT];
};

/* Bins the geometry. prepaints: one per draw; NULL: none. Adds the counts of draws that are not `counted`. Returns
 * ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_binned_scene_make(const struct zr_run *run, const struct zr_geometry *geometry,
                                    const struct zr_prepaint *prepaints, uint32_t width, uint32_t height,
                                    const struct zr_base *base, struct zr_binned_scene *binned);

#endif
