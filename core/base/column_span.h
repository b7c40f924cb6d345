/* column_span.h - base: spans of columns that contain all covered pixels of a row. */
#ifndef ZR_COLUMN_SPAN_H
#define ZR_COLUMN_SPAN_H

#include <stdint.h>

/* Columns begin .. end - 1; empty if begin >= end. */
struct zr_column_span {
    uint32_t begin, end;
};

/* Returns the smallest span that contains both. */
static inline struct zr_column_span zr_column_span_join(struct zr_column_span a, struct zr_column_span b)
{
    if (a.begin >= a.end) return b;
    if (b.begin >= b.end) return a;
    return (struct zr_column_span){a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

/* The span of rows y - 1 and y. `spans`: one span per row, or NULL: every span is the whole width. */
static inline struct zr_column_span zr_column_span_of_rows(const struct zr_column_span *spans, uint32_t y,
                                                           uint32_t width)
{
    if (!spans || y == 0) return (struct zr_column_span){0, width};
    return zr_column_span_join(spans[y - 1], spans[y]);
}

#endif
