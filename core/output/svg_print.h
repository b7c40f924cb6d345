/* svg_print.h - output: pieces of SVG.
 *
 * Exact:  the same bytes for every machine, LC_NUMERIC being "C". */
#ifndef ZR_SVG_PRINT_H
#define ZR_SVG_PRINT_H

#include "output/bytes/buffer.h"

/* Appends a text of less than 512 bytes, in the manner of printf. */
__attribute__((format(printf, 2, 3))) void zr_svg_print(struct zr_buffer *out, const char *format, ...);

/* Returns the decimals that a hundredth of a pixel needs. `pixel`: its length in units of the output, more than 0. */
int zr_svg_decimals(double pixel);

/* Appends a coordinate; never "-0.00". */
void zr_svg_print_number(struct zr_buffer *out, double value, int decimals);

/* Appends a value of an attribute. Characters that XML does not allow become "?". `text`: valid UTF-8. */
void zr_svg_print_escaped(struct zr_buffer *out, const char *text);

#endif
