/* binned_scene.h - raster: production's visibility: primitives sorted into tiles, and each tile drawn by half-spaces.
 *
 * Blocks of a tile may stay known and not written (zr_tile.unwritten).
 */
#ifndef ZR_BINNED_SCENE_H
#define ZR_BINNED_SCENE_H

#include "raster/bins.h"
#include "raster/halfspace.h"
#include "raster/misc_bins.h"
#include "raster/small.h"
#include "raster/visibility.h"

/* Primitives of materials of one mode, sorted into tiles. */
struct zr_mode_bins {
    struct zr_bins bins;
    struct zr_misc_bins others;
};

/* The geometry of a window, sorted by mode and tile. */
struct zr_binned_scene {
    struct zr_visibility visibility;
    const struct zr_geometry *geometry;
    const struct zr_prepaint *payloads; /* one per draw, or NULL */
    const struct zr_base *base;         /* or NULL */
    const struct zr_halfspace *halfspace;
    zr_small_fn *draw_small;
    uint32_t width, height;
    struct zr_mode_bins sorted[ZR_ALPHA_COUNT];
};

/* Sorts the geometry into tiles. payloads: one per draw; NULL: none. Counts what became of draws that are not
 * `counted`. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_binned_scene_make(struct zr_arena *arena, struct zr_team *team, const struct zr_geometry *geometry,
                                    const struct zr_prepaint *payloads, uint32_t width, uint32_t height,
                                    const struct zr_base *base, const struct zr_cancel *cancel,
                                    struct zr_binned_scene *visible);

#endif
