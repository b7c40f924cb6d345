/* cap_samples.h - geometry: which samples the caps of a plane have taken.
 *
 * Space:  rows and columns of samples of the window.
 * Why:    caps of parts that overlap lie in one plane. Their depths are equal but for rounding, so that the samples of
 *         both would be mixed. Each sample therefore belongs to the first opaque cap that covers it: to the part with
 *         the lowest number. Translucent caps take no samples, and are layers in front of or behind opaque ones.
 * Memory: one bit per sample and plane, only for planes with two caps and more. */
#ifndef ZR_CAP_SAMPLES_H
#define ZR_CAP_SAMPLES_H

#include "base/arena.h"
#include "scene/scene.h"

struct zr_cap_samples {
    uint32_t words;                        /* per row */
    uint64_t *bits[ZR_SECTION_PLANES_MAX]; /* per plane; NULL: no samples are shared */
};

/* Makes the bits, of which none is set. False: the arena has no memory. */
bool zr_cap_samples_make(struct zr_arena *arena, const struct zr_scene *scene, uint32_t width, uint32_t height,
                         struct zr_cap_samples *cap_samples);

/* Returns the end of the samples from `column` on, at most `end`, that are all taken, or all free. Sets *is_taken. */
int32_t zr_cap_samples_run(const struct zr_cap_samples *cap_samples, uint32_t plane, int32_t row, int32_t column,
                           int32_t end, bool *is_taken);

/* Takes the samples begin .. end - 1 of a row. */
void zr_cap_samples_take(const struct zr_cap_samples *cap_samples, uint32_t plane, int32_t row, int32_t begin,
                         int32_t end);

#endif
