/* whole_window.h - raster: visibility by algorithms that decide a whole window at once. */
#ifndef ZR_WHOLE_WINDOW_H
#define ZR_WHOLE_WINDOW_H

#include "base/run.h"
#include "raster/textbook/algorithms.h"
#include "raster/visibility.h"

/* Samples of a window, and the lists of the modes that are listed. */
struct zr_whole_window {
    struct zr_visibility visibility;
    struct zr_samples samples;
    struct zr_fragments lists[ZR_ALPHA_COUNT]; /* one list per sample; without `ends`: none */
};

/* Decides the geometry's window, and lists the fragments of the alpha modes that are `listed`. One thread. Returns
 * ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY, ZR_BAD_SCENE beyond the painter's limit of work, or ZR_INTERNAL if the algorithm
 * fails its own checks. */
enum zr_status zr_whole_window_make(const struct zr_run *run, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, const bool listed[ZR_ALPHA_COUNT],
                                    const struct zr_base *base, struct zr_whole_window *window);

/* ---- its steps ---- */

/* Allocates the window's samples in the arena, clears them as tiles are cleared, and draws opaque primitives. */
enum zr_status zr_visibility_window(const struct zr_run *run, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, uint32_t width, uint32_t height,
                                    const struct zr_base *base, struct zr_samples *samples);

/* Makes one list per sample: the fragments of one alpha mode in front of the samples, or as deep, which are decided. */
enum zr_status zr_visibility_window_fragments(const struct zr_run *run, const struct zr_geometry *geometry,
                                              zr_visibility_fn *visibility, enum zr_alpha_mode mode,
                                              struct zr_samples *samples, struct zr_fragments *fragments);

/* Copies tile `number` from decided samples. All of it is written. */
void zr_visibility_load(const struct zr_samples *samples, uint32_t number, struct zr_tile *tile);

#endif
