/* filter.h - output: applies PNG's filter UP to rows of pixels, which leaves the difference from the row above.
 *
 * Why UP: rendered pictures repeat downwards; the background becomes zeros; and UP is the cheapest filter to undo.
 * Every processor gives the same bytes. */
#ifndef ZR_FILTER_H
#define ZR_FILTER_H

#include <stddef.h>
#include <stdint.h>

#include "base/column_span.h"

/* Adler-32, the checksum of a zlib stream, combined from parts.
 *
 * A part has two sums modulo 65521: `a` of its bytes, and `b` of its bytes times the number of bytes from each to the
 * end. A part starts at 0; the stream's initial 1 is zr_adler_begin. Several threads can therefore sum parts, and a run
 * of zeros costs nothing.
 * Source: RFC 1950, section 9. */
enum { ZR_ADLER_PRIME = 65521 };

struct zr_adler {
    uint32_t a, b;
};

static inline struct zr_adler zr_adler_begin(void)
{
    return (struct zr_adler){1, 0};
}

/* Appends `size` bytes with the sum `a` and the weighted sum `b`, not reduced; b must be below 2^62. */
static inline void zr_adler_add(struct zr_adler *sum, uint64_t size, uint64_t a, uint64_t b)
{
    sum->b = (uint32_t)((sum->b + size % ZR_ADLER_PRIME * sum->a + b) % ZR_ADLER_PRIME);
    sum->a = (uint32_t)((sum->a + a) % ZR_ADLER_PRIME);
}

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
