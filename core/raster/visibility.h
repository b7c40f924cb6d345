/* visibility.h - raster, the whole floor: primitives -> visibility, sample by sample.
 *
 * Production works tile by tile (zr_visibility_tile). The textbooks' other ways stand beside
 * it, each in a file of its own behind zr_visibility_fn. They share the snapped grid, the
 * rule that says what is inside, and each primitive's own depth at a sample (primitive.h), and
 * nothing else; so they must agree on every sample, and each is a proof of the others.
 */
#ifndef ZR_VISIBILITY_H
#define ZR_VISIBILITY_H

#include "raster/bins.h"
#include "raster/halfspace.h"
#include "raster/misc_bins.h"
#include "raster/samples.h"
#include "raster/small.h"

/* Primitives of materials of one mode, sorted into tiles. */
struct zr_mode_bins {
    struct zr_bins bins;
    struct zr_misc_bins others;
};

/* All that tiles are drawn from. */
struct zr_binned_scene {
    const struct zr_geometry *geometry;
    const struct zr_prepaint *payloads; /* one a draw, or NULL */
    const struct zr_halfspace *halfspace;
    zr_small_fn *draw_small;
    uint32_t width, height;
    struct zr_mode_bins sorted[ZR_ALPHA_COUNT];
};

/* Sorts the geometry into tiles. payloads: one a draw; NULL: none. What became of draws that are not `counted` is then
 * in their bins' counts. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_binned_scene_make(struct zr_arena *arena, struct zr_team *team, const struct zr_geometry *geometry,
                                    const struct zr_prepaint *payloads, uint32_t width, uint32_t height,
                                    const struct zr_cancel *cancel, struct zr_binned_scene *visible);

/* Places tile `number` in the window, begins it (`base` may be NULL) and draws into it every
 * primitive that touches it. Blocks may be left that are known and not written (zr_tile.unwritten). Reentrant: one
 * tile, one thread. False where it was cancelled: the tile is then incomplete. */
bool zr_visibility_tile(const struct zr_binned_scene *visible, uint32_t number, const struct zr_base *base,
                        const struct zr_cancel *cancel, struct zr_tile *tile);

/* Whether any primitive of such a material may touch tile `number`. */
bool zr_visibility_has_any(const struct zr_binned_scene *visible, uint32_t number, enum zr_alpha_mode mode);

/* Puts what primitives of such materials cover of the tile, in front of what is seen there, into its lists
 * (zr_tile.fragments); all of the tile is written. False where it was cancelled. */
bool zr_visibility_fragments(const struct zr_binned_scene *visible, uint32_t number, enum zr_alpha_mode mode,
                             const struct zr_cancel *cancel, struct zr_tile *tile);

/* Draws the primitives that they take into samples that have been cleared: no owner, and the depth below which
 * something is seen; or into their lists. One thread. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY; the painter's could also
 * find its own proof wrong, ZR_INTERNAL. All of the geometry's draws are `counted`. */
typedef enum zr_status zr_visibility_fn(struct zr_arena *arena, const struct zr_geometry *geometry,
                                        const struct zr_cancel *cancel, struct zr_samples *samples);

/* NULL for ZR_ALGORITHM_HALFSPACE, which works in tiles. */
zr_visibility_fn *zr_visibility_of(enum zr_algorithm algorithm);

/* Makes samples for the whole window, begins them as tiles begin, draws what is opaque into them, and leaves them in
 * the arena. */
enum zr_status zr_visibility_window(struct zr_arena *arena, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, uint32_t width, uint32_t height,
                                    const struct zr_base *base, const struct zr_cancel *cancel,
                                    struct zr_samples *samples);

/* Lists of what primitives of such materials cover in front of samples that are decided: one a sample. */
enum zr_status zr_visibility_window_fragments(struct zr_arena *arena, const struct zr_geometry *geometry,
                                              zr_visibility_fn *visibility, enum zr_alpha_mode mode,
                                              const struct zr_cancel *cancel, struct zr_samples *samples,
                                              struct zr_fragments *fragments);

/* Tile `number` of a window whose samples are decided: all of them are written. */
void zr_visibility_load(const struct zr_samples *samples, uint32_t number, struct zr_tile *tile);

#endif
