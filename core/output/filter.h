/* filter.h - output: rows of pixels -> what PNG's filter UP leaves of them: the difference from the row above.
 *
 * Pixels stay apart as they are in memory, 1, 2 or 4 bytes each, so that four of them are compared at once; their
 * bytes are those of the file, in its order, and what the file leaves out is 0. Behind a row's last byte
 * ZR_FILTER_PADDING more are read, and never matter.
 * Why UP: what a rasterizer draws repeats downwards; the background becomes zeros; and it is the cheapest to undo.
 */
#ifndef ZR_FILTER_H
#define ZR_FILTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "output/adler.h"

enum { ZR_FILTER_PADDING = 256, ZR_FILTER_UP = 2 };

enum zr_layout {
    ZR_LAYOUT_8,    /* one byte: grey, or the index of a colour */
    ZR_LAYOUT_16,   /* a uint16_t of the machine's, the high byte first in the file */
    ZR_LAYOUT_RGB,  /* RGBA in memory, RGB in the file */
    ZR_LAYOUT_RGBA, /* RGBA in both */
    ZR_LAYOUT_COUNT
};

/* Bytes a pixel. Inline, so that loops know them as constants. */
static inline unsigned zr_layout_memory(enum zr_layout layout)
{
    return layout == ZR_LAYOUT_8 ? 1 : layout == ZR_LAYOUT_16 ? 2 : 4;
}

static inline unsigned zr_layout_file(enum zr_layout layout)
{
    return layout == ZR_LAYOUT_RGB ? 3 : zr_layout_memory(layout);
}

/* Pixels begin..end-1. */
struct zr_span {
    uint32_t begin, end;
};

/* From the first pixel that differs from the one above to the last; empty at `width` where none does. */
struct zr_span zr_filter_span(enum zr_layout layout, const uint8_t *row, const uint8_t *above, uint32_t width);

/* Writes the differences of the pixels of `span` to `out`, which holds the whole row, and adds the file's bytes of
 * these pixels to `sum`. */
void zr_filter_row(enum zr_layout layout, const uint8_t *row, const uint8_t *above, struct zr_span span, uint8_t *out,
                   struct zr_adler *sum);

/* Bit i: the i-th pixel from `filtered` on is not equal to the one before it. Of 64. */
uint64_t zr_filter_changes(enum zr_layout layout, const uint8_t *filtered);

#endif
