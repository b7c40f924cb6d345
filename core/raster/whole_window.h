/* whole_window.h - raster: visibility of algorithms that decide a whole window before the first tile is asked for.
 */
#ifndef ZR_WHOLE_WINDOW_H
#define ZR_WHOLE_WINDOW_H

#include "raster/textbook/algorithms.h"
#include "raster/visibility.h"

/* The samples of a window, and the lists of the modes that have some. */
struct zr_whole_window {
    struct zr_visibility visibility;
    struct zr_samples samples;
    struct zr_fragments lists[ZR_ALPHA_COUNT]; /* one list per sample; without `ends`: none */
};

/* Decides the window of the geometry, and lists the primitives of materials of the modes that are `listed`. One thread.
 * ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY, or ZR_INTERNAL where the algorithm finds itself wrong. */
enum zr_status zr_whole_window_make(struct zr_arena *arena, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, const bool listed[ZR_ALPHA_COUNT],
                                    const struct zr_base *base, const struct zr_cancel *cancel,
                                    struct zr_whole_window *window);

/* ---- parts of it ---- */

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
