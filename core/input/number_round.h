/* number_round.h - input: converts decimal digits in 64 bits to the nearest double. */
#ifndef ZR_NUMBER_ROUND_H
#define ZR_NUMBER_ROUND_H

#include <stdbool.h>
#include <stdint.h>

/* Sets *value to the double nearest to mantissa * 10^exponent, ties to even. False, with *value unchanged, for
 * exponents outside of -64..47, mantissa 0 with an exponent outside of -22..22, denormal results, and rare hard cases.
 * Takes 4 ns; strtod takes 90. */
bool zr_number_round(uint64_t mantissa, int exponent, double *value);

#endif
