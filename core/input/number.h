/* number.h - input: reads decimal numbers of any length as the nearest double.
 *
 * Why:  strtod needs a terminating zero, depends on the locale, and accepts "inf", "nan" and hexadecimal. All formats
 *       share one definition: the value is the nearest double, and a float is that double converted.
 */
#ifndef ZR_NUMBER_H
#define ZR_NUMBER_H

/* Reads [+-] digits [. digits] [e [+-] digits] at the start of at..end, with at least one digit before or after the
 * point. Returns the byte behind it, which the caller checks; NULL if there is no number. Overflow gives an
 * infinity. */
const char *zr_number_read(const char *at, const char *end, double *value);

/* The same for a number of JSON (RFC 8259, section 6): no plus sign, no leading zeros, digits on both sides of a
 * point. */
const char *zr_number_read_json(const char *at, const char *end, double *value);

#endif
