/* filter.h - output: rows of pixels -> the file's bytes after PNG's filter UP, which leaves the difference from the row
 * above.
 *
 * Why UP: what a rasterizer draws repeats downwards; the background becomes zeros; and it is the cheapest to undo.
 * The bytes are the same whatever the processor can do.
 */
#ifndef ZR_FILTER_H
#define ZR_FILTER_H

#include <stddef.h>
#include <stdint.h>

#include "base/column_span.h"
#include "output/adler.h"

enum {
    ZR_FILTER_UP = 2,
    ZR_FILTER_PADDING = 16 /* bytes behind a row's last that may be written over */
};

enum zr_layout {
    ZR_LAYOUT_8,    /* one byte: grey, or the index of a colour */
    ZR_LAYOUT_16,   /* a uint16_t of the machine's, the high byte first in the file */
    ZR_LAYOUT_RGB,  /* RGBA in memory, RGB in the file */
    ZR_LAYOUT_RGBA, /* RGBA in both */
    ZR_LAYOUT_COUNT
};

/* Bytes a pixel. */
static inline unsigned zr_layout_memory(enum zr_layout layout)
{
    return layout == ZR_LAYOUT_8 ? 1 : layout == ZR_LAYOUT_16 ? 2 : 4;
}

static inline unsigned zr_layout_file(enum zr_layout layout)
{
    return layout == ZR_LAYOUT_RGB ? 3 : zr_layout_memory(layout);
}

/* The part of a reach outside of which all pixels are equal to those above; at its ends some may be, up to 64 bytes of
 * them. */
struct zr_column_span zr_filter_reach(enum zr_layout layout, const uint8_t *row, const uint8_t *above,
                                      struct zr_column_span reach);

/* Writes the filter's number and the row, 1 + width * zr_layout_file(layout) bytes, to `out` and adds them to `sum`.
 * Pixels that are equal to those above take next to no time; what is outside of `reach` is known to be, and is not even
 * read. */
void zr_filter_row(enum zr_layout layout, const uint8_t *row, const uint8_t *above, uint32_t width,
                   struct zr_column_span reach, uint8_t *out, struct zr_adler *sum);

#endif
