/* decimal.h - overlay: numbers of few digits, and how they are written.
 *
 * A number that people read beside a picture is kept as whole digits and a power of ten, so that what is written is
 * what was meant: 3 * 10^-1 is "0.3", whatever a float makes of it. Nothing here asks the locale or the C library's
 * printf, and the same number is written in the same way everywhere.
 */
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

/* Without zeros at its end, which the exponent has instead; 0 has the exponent 0. */
struct zr_decimal zr_decimal_trim(struct zr_decimal number);

/* The fewest digits that are read as this float, which is finite; up to nine of them. */
struct zr_decimal zr_decimal_of_float(float value);

/* Within a few units in the last place of a double; exact where digits and power are below 2^53 and 10^22. Exponents
 * from -60 to 60. */
double zr_decimal_value(struct zr_decimal number);

/* Room for the longest plain one, and the zero behind it. */
enum { ZR_DECIMAL_SIZE = 96 };

/* Writes it as "-0.25", or where `scientific` as "-2.5e-1"; 0 is "0". Returns the length. `number` is trimmed, its
 * exponent from -60 to 60. */
size_t zr_decimal_write(struct zr_decimal number, bool scientific, char out[ZR_DECIMAL_SIZE]);

#endif
