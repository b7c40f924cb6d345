/* ticks.h - overlay: round numbers along a range, for scales and axes, and their text.
 *
 * Steps are 1, 2 or 5 times a power of ten, as on rulers. Source: the usual choice of plotting programs; P. S.
 * Heckbert, "Nice Numbers for Graph Labels", Graphics Gems (1990).
 */
#ifndef ZR_TICKS_H
#define ZR_TICKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A decimal number of few digits: digits * 10^exponent. So the text of a label is exact: 3 * 10^-1 is "0.3", although
 * no float is. Nothing depends on the locale or the C library's printf: the text is the same everywhere. */
struct zr_decimal {
    int64_t digits;
    int exponent;
};

/* Moves trailing zeros to the exponent; 0 gets the exponent 0. */
struct zr_decimal zr_decimal_trim(struct zr_decimal number);

/* Returns the fewest digits, at most nine, that read back as this finite float. */
struct zr_decimal zr_decimal_of_float(float value);

/* Returns the value within a few units in the last place of a double; exact if digits are below 2^53 and the power is
 * below 10^22. Exponents from -60 to 60. */
double zr_decimal_value(struct zr_decimal number);

/* Size of the longest plain text, with its terminating zero. */
enum { ZR_DECIMAL_SIZE = 96 };

/* Writes the number as "-0.25", or with `scientific` as "-2.5e-1"; 0 is "0". Returns the length. `number` must be
 * trimmed, with an exponent from -60 to 60. */
size_t zr_decimal_write(struct zr_decimal number, bool scientific, char out[ZR_DECIMAL_SIZE]);

enum { ZR_TICKS_MAX = 24 };

struct zr_ticks {
    int count;
    bool has_ends;      /* the first and the last tick are the ends of the range */
    bool is_scientific; /* write all of them in scientific notation, since some would be long */
    struct zr_decimal at[ZR_TICKS_MAX];
};

/* Returns ticks from low to high, ascending: multiples of the smallest round step that is at least `apart` (>= 0.1)
 * times the range. A multiple that rounds to `low` or `high` as a float counts as within, unless it is farther than
 * 0.005 of the range away. If apart <= 0.2 and low < high, there are at least two. With `ends`, returns both ends, in
 * the fewest digits that identify them, and the multiples at least `apart` from both. If low == high, returns that
 * number only. Both must be finite, low <= high. */
struct zr_ticks zr_ticks_make(float low, float high, double apart, bool ends);

/* Returns the position of tick `i` between low and high: 0 to 1; 0.5 if these are equal. */
double zr_tick_share(const struct zr_ticks *ticks, int i, float low, float high);

#endif
