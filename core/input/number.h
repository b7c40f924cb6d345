/* number.h - input: decimal text -> double, correctly rounded, at any length.
 *
 * Why:  strtod wants a terminating zero, obeys the locale, and takes "inf",
 *       "nan" and hexadecimal. One definition holds for all formats: the value is
 *       the nearest double, and a float is that double converted.
 */
#ifndef ZR_NUMBER_H
#define ZR_NUMBER_H

/* Reads [+-] digits [. digits] [e [+-] digits], with at least one digit before or
 * after the point, from the start of at..end, and returns where it ends, or
 * NULL where there is no such number. Too large a number gives an infinity. What
 * follows the number is the caller's to judge. */
const char *zr_number_read(const char *at, const char *end, double *value);

/* The same for what is a number of JSON (RFC 8259, section 6): no plus sign, no leading zeros, digits on both
 * sides of a point. */
const char *zr_number_read_json(const char *at, const char *end, double *value);

#endif
