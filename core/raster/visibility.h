/* visibility.h - raster: visibility of a window, tile by tile.
 *
 * One interface stands before two kinds of algorithms. Production sorts primitives into tiles and draws a tile when it
 * is asked for (binned_scene.h). The textbooks' algorithms, each in a file of its own behind zr_visibility_fn, decide
 * the whole window at once (whole_window.h). They share the snapped grid, the rule that says which samples are inside,
 * and each primitive's own depth at a sample (primitive.h), and nothing else; so they must agree on every sample, and
 * each is a proof of the others.
 */
#ifndef ZR_VISIBILITY_H
#define ZR_VISIBILITY_H

#include "base/cancel.h"
#include "geometry/geometry.h"
#include "raster/tile.h"

/* Reentrant: one tile, one thread. Functions that return false were cancelled: the tile is then incomplete. */
struct zr_visibility {
    /* Places tile `number` in the window, begins it, from the base where there is one, and gives each sample its
     * nearest opaque primitive. */
    bool (*tile)(const struct zr_visibility *visibility, uint32_t number, const struct zr_cancel *cancel,
                 struct zr_tile *tile);

    /* Whether any primitive of a material of that mode may touch tile `number`. */
    bool (*has_any)(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode);

    /* Puts what primitives of materials of that mode cover of the tile, in front of its samples, into its lists
     * (zr_tile.fragments). All of the tile is written before. */
    bool (*fragments)(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode,
                      const struct zr_cancel *cancel, struct zr_tile *tile);

    struct zr_counts counts; /* of draws that are not `counted` */
};

static inline bool zr_visibility_tile(const struct zr_visibility *visibility, uint32_t number,
                                      const struct zr_cancel *cancel, struct zr_tile *tile)
{
    return visibility->tile(visibility, number, cancel, tile);
}

static inline bool zr_visibility_has_any(const struct zr_visibility *visibility, uint32_t number,
                                         enum zr_alpha_mode mode)
{
    return visibility->has_any(visibility, number, mode);
}

static inline bool zr_visibility_fragments(const struct zr_visibility *visibility, uint32_t number,
                                           enum zr_alpha_mode mode, const struct zr_cancel *cancel,
                                           struct zr_tile *tile)
{
    return visibility->fragments(visibility, number, mode, cancel, tile);
}

#endif
