/* column_span.h - base: which columns of a row of pixels may show something. */
#ifndef ZR_COLUMN_SPAN_H
#define ZR_COLUMN_SPAN_H

#include <stdint.h>

/* Columns begin .. end - 1. */
struct zr_column_span {
    uint32_t begin, end;
};

/* What both reach. */
static inline struct zr_column_span zr_column_span_join(struct zr_column_span a, struct zr_column_span b)
{
    if (a.begin >= a.end) return b;
    if (b.begin >= b.end) return a;
    return (struct zr_column_span){a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

/* Of row `y` and the one above it, where those of all rows are known, or NULL. */
static inline struct zr_column_span zr_column_span_of_rows(const struct zr_column_span *reaches, uint32_t y,
                                                           uint32_t width)
{
    if (!reaches || y == 0) return (struct zr_column_span){0, width};
    return zr_column_span_join(reaches[y - 1], reaches[y]);
}

#endif
