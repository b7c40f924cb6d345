/* visibility.h - raster: visibility of a window, tile by tile.
 *
 * One interface serves two kinds of algorithms. Production bins primitives by tile and draws a tile on request
 * (binned_scene.h). The textbooks' algorithms, each in a file of its own behind zr_visibility_fn, decide the whole
 * window at once (whole_window.h). They share only the snapped grid, the rule that decides which samples are inside,
 * and each primitive's depth at a sample (primitive.h). They must agree on every sample, so each checks the others.
 */
#ifndef ZR_VISIBILITY_H
#define ZR_VISIBILITY_H

#include "base/cancel.h"
#include "geometry/geometry.h"
#include "raster/tile.h"

/* Reentrant; one thread per tile. Functions return false if cancelled; the tile is then incomplete. */
struct zr_visibility {
    /* Places tile `number` in the window, clears it, from the base if there is one, and gives each sample its nearest
     * opaque primitive. */
    bool (*tile)(const struct zr_visibility *visibility, uint32_t number, const struct zr_cancel *cancel,
                 struct zr_tile *tile);

    /* Returns true if a primitive with that alpha mode may touch tile `number`. */
    bool (*has_any)(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode);

    /* Adds fragments to the tile's lists (zr_tile.fragments): those of primitives with that alpha mode, in front of the
     * tile's samples, which are all written. */
    bool (*fragments)(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode,
                      const struct zr_cancel *cancel, struct zr_tile *tile);

    /* Draws the primitives with that alpha mode as if they were opaque, to a tile all samples of which are written and
     * which keeps no early colours. */
    bool (*draw)(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode,
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

static inline bool zr_visibility_draw(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode,
                                      const struct zr_cancel *cancel, struct zr_tile *tile)
{
    return visibility->draw(visibility, number, mode, cancel, tile);
}

#endif
