/* decimal.h - overlay: decimal numbers of few digits, and their text.
 *
 * Labels are kept as whole digits and a power of ten, so that the text is exact: 3 * 10^-1 is "0.3", although no float
 * is. Nothing depends on the locale or the C library's printf: the text is the same everywhere. */
#ifndef ZR_DECIMAL_H
#define ZR_DECIMAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* digits * 10^exponent. */
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

#endif
