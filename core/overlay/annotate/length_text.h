/* length_text.h - overlay: lengths as text.
 *
 * Digits: four that count, and at most three decimals; more only if the largest length beside it is below 1. Zeros at
 *         the end go. Powers of ten are products in a fixed order: the text is the same everywhere. */
#ifndef ZR_LENGTH_TEXT_H
#define ZR_LENGTH_TEXT_H

enum { ZR_LENGTH_SIZE = 128 };

/* Writes a length. `largest`: the largest one beside it. `unit`: sign that follows after a space; "": none. */
void zr_length_write(double length, double largest, const char *unit, char out[ZR_LENGTH_SIZE]);

/* Returns the sign of a unit of zr_file_facts, such as "mm", or "" for none. */
const char *zr_unit_sign(const char *unit);

/* Returns the millimetres of such a unit; 0: unknown. */
double zr_unit_millimetres(const char *unit);

/* Returns the largest 1, 2 or 5 times a power of ten that is at most `most` > 0, and its first digit. */
double zr_length_round(double most, int *digit);

#endif
