/* paint.h - shade: the colours of runs of pixels. A kernel.
 *
 * Exact:  the reference's rule 9: colours times 1/w are planes over the window, each pixel divides by the plane of
 *         1/w, and bytes are rounded to the nearest.
 * How:    planes are not kept from the drawing of visibility: only what is seen is set up, as many
 *         runs at once as there are lanes. Short runs are then painted side by side, one a lane; long ones one
 *         after the other, a pixel a lane.
 */
#ifndef ZR_PAINT_H
#define ZR_PAINT_H

#include "base/isa.h"
#include "geometry/geometry.h"

/* Pixels of one row of a tile that belong to one record. */
struct zr_run {
    uint32_t number; /* of the record */
    int32_t x, y;    /* of its first pixel, window space, y up */
    uint32_t count;
    uint32_t *pixels; /* RGBA, four bytes each, to be written */
};

struct zr_paint {
    void (*runs)(const struct zr_geometry *geometry, const struct zr_run *runs, uint32_t count);

    /* Where runs end in a row of a tile: bit i, where owners[i] is the last of its own among the first `width`. */
    uint64_t (*ends)(const uint32_t *owners, int32_t width);

    /* `rows` rows of `width`, `stride` apart, of one value of four bytes. */
    void (*fill)(void *pixels, uint32_t value, int32_t width, int32_t rows, ptrdiff_t stride);
};

extern const struct zr_paint zr_paint_scalar, zr_paint_sse2, zr_paint_avx2, zr_paint_avx512, zr_paint_neon;

const struct zr_paint *zr_paint_of(enum zr_isa isa);

/* 0..1 -> 0..255, to the nearest, ties to even. NaN gives 0. */
uint32_t zr_color_byte(float value);

/* Four bytes in memory: red, green, blue, alpha. */
uint32_t zr_color_pack(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha);

/* A line's run, for the kernel: planes that vary along its major axis alone. */
void zr_paint_line(const struct zr_geometry *geometry, const struct zr_triangle *line, const struct zr_run *run);

#endif
