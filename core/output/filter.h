/* filter.h - output: applies PNG's filter UP to rows of pixels, which leaves the difference from the row above.
 *
 * Why UP: rendered pictures repeat downwards; the background becomes zeros; and UP is the cheapest filter to undo.
 * Every processor gives the same bytes. */
#ifndef ZR_FILTER_H
#define ZR_FILTER_H

#include <stddef.h>
#include <stdint.h>

#include "base/column_span.h"
#include "output/adler.h"

enum {
    ZR_FILTER_UP = 2,
    ZR_FILTER_PADDING = 16 /* bytes after the end of a row that may be overwritten */
};

enum zr_layout {
    ZR_LAYOUT_8,    /* one byte: grey, or a palette index */
    ZR_LAYOUT_16,   /* uint16_t in native byte order, in the file high byte first */
    ZR_LAYOUT_RGB,  /* RGBA in memory, RGB in the file */
    ZR_LAYOUT_RGBA, /* RGBA in both */
    ZR_LAYOUT_COUNT
};

/* Bytes per pixel in memory. */
static inline unsigned zr_layout_memory(enum zr_layout layout)
{
    return layout == ZR_LAYOUT_8 ? 1 : layout == ZR_LAYOUT_16 ? 2 : 4;
}

static inline unsigned zr_layout_file(enum zr_layout layout)
{
    return layout == ZR_LAYOUT_RGB ? 3 : zr_layout_memory(layout);
}

/* Returns the part of `bounds` outside of which all pixels equal those above. It may include up to 64 bytes of equal
 * pixels at either end. */
struct zr_column_span zr_filter_span(enum zr_layout layout, const uint8_t *row, const uint8_t *above,
                                     struct zr_column_span bounds);

/* Writes the filter's number and the filtered row, 1 + width * zr_layout_file(layout) bytes, to `out` and adds them to
 * `sum`. Pixels outside of `bounds` must equal those above and are not read; other equal pixels take little time. */
void zr_filter_row(enum zr_layout layout, const uint8_t *row, const uint8_t *above, uint32_t width,
                   struct zr_column_span bounds, uint8_t *out, struct zr_adler *sum);

#endif
