/* reach.h - base: which columns of a row of pixels may show something. */
#ifndef ZR_REACH_H
#define ZR_REACH_H

#include <stdint.h>

/* Columns begin .. end - 1. */
struct zr_reach {
    uint32_t begin, end;
};

/* What both reach. */
static inline struct zr_reach zr_reach_join(struct zr_reach a, struct zr_reach b)
{
    if (a.begin >= a.end) return b;
    if (b.begin >= b.end) return a;
    return (struct zr_reach){a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

/* Of row `y` and the one above it, where those of all rows are known, or NULL. */
static inline struct zr_reach zr_reach_of_two(const struct zr_reach *reaches, uint32_t y, uint32_t width)
{
    if (!reaches || y == 0) return (struct zr_reach){0, width};
    return zr_reach_join(reaches[y - 1], reaches[y]);
}

#endif
