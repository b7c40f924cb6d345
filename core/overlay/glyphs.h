/* glyphs.h - overlay: text in a finished picture, by a font of dots: all of ASCII, and what units are written with:
 * degree, plus-minus, superscripts 1 2 3 and minus, micro, middle dot, times, minus, and some Greek letters.
 *
 * Capitals and digits are five dots wide and seven high; nothing is wider, and two rows below are for letters such as
 * g. A dot is `scale` pixels a side. What has no glyph is drawn as an empty box. Texts are UTF-8.
 */
#ifndef ZR_GLYPHS_H
#define ZR_GLYPHS_H

#include <stdbool.h>

#include "overlay/canvas.h"

enum { ZR_GLYPH_ROWS = 9, ZR_GLYPH_CAPITAL_ROWS = 7 };

/* Dots from the first to the last column of the text; 0 where it is empty. */
int32_t zr_glyphs_width(const char *text);

/* False where some character has no glyph. */
bool zr_glyphs_has_all(const char *text);

/* x and y: the upper left corner of the first capital, in pixels. Each dot is `grow` pixels larger on all sides: text
 * in one colour, grown, and once more in another, not grown, is legible on everything. */
void zr_glyphs_draw(const struct zr_canvas *canvas, const char *text, int32_t x, int32_t y, int32_t scale, int32_t grow,
                    uint32_t color);

#endif
