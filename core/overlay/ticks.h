/* ticks.h - overlay: round numbers along a range, for scales and axes.
 *
 * Steps are 1, 2 or 5 times a power of ten, as on rulers. Source: the usual choice of plotting programs; P. S.
 * Heckbert, "Nice Numbers for Graph Labels", Graphics Gems (1990).
 */
#ifndef ZR_TICKS_H
#define ZR_TICKS_H

#include <stdbool.h>

#include "overlay/decimal.h"

enum { ZR_TICKS_MAX = 24 };

struct zr_ticks {
    int count;
    bool has_ends;      /* the first and the last are those of the range */
    bool is_scientific; /* all are to be written so: plainly some would be long */
    struct zr_decimal at[ZR_TICKS_MAX];
};

/* Multiples of the smallest round step that is at least the share `apart` of the range, 0.1 <= apart, from low to high,
 * rising; what is `low` or `high` once it is a float counts as within, unless that is more than half a hundredth of the
 * range away. There are two at least where apart <= 0.2, and low < high. With `ends` both ends themselves, in the
 * fewest digits that tell them, and the multiples that are not nearer to these than `apart`. Where low == high: that
 * number alone. Both are finite, low <= high. */
struct zr_ticks zr_ticks_make(float low, float high, double apart, bool ends);

/* Where between low and high tick `i` is: 0 to 1; 0.5 where these are equal. */
double zr_tick_share(const struct zr_ticks *ticks, int i, float low, float high);

#endif
