/* visibility.h - raster, the whole floor: primitives -> who is seen, sample by sample.
 *
 * Production works tile by tile (zr_visibility_tile). The textbooks' other ways stand beside
 * it, each in a file of its own behind zr_visibility_fn. They share the snapped grid, the
 * rule that says what is inside, and each record's own depth at a sample (primitive.h), and
 * nothing else; so they must agree on every sample, and each is a proof of the others.
 */
#ifndef ZR_VISIBILITY_H
#define ZR_VISIBILITY_H

#include "raster/bins.h"
#include "raster/samples.h"

/* Places tile `number` in the window, begins it (`base` may be NULL) and draws into it every
 * primitive that touches it. Reentrant: one tile, one thread. False where it was
 * cancelled: the tile is then incomplete. */
bool zr_visibility_tile(const struct zr_geometry *geometry, const struct zr_bins *bins, uint32_t number, uint32_t width,
                        uint32_t height, const struct zr_base *base, const struct zr_cancel *cancel,
                        struct zr_tile *tile);

/* Draws all primitives into samples that have been cleared: no owner, and the depth below which
 * something is seen. One thread. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
typedef enum zr_status zr_visibility_fn(struct zr_arena *arena, const struct zr_geometry *geometry,
                                        const struct zr_cancel *cancel, struct zr_samples *samples);

/* NULL for ZR_ALGORITHM_HALFSPACE, which works in tiles. */
zr_visibility_fn *zr_visibility_of(enum zr_algorithm algorithm);

/* Makes samples for the whole window, begins them as tiles begin, draws into them, and leaves them in the arena. */
enum zr_status zr_visibility_window(struct zr_arena *arena, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, uint32_t width, uint32_t height,
                                    const struct zr_base *base, const struct zr_cancel *cancel,
                                    struct zr_samples *samples);

/* Tile `number` of a window whose samples are decided. */
void zr_visibility_load(const struct zr_samples *samples, uint32_t number, struct zr_tile *tile);

#endif
