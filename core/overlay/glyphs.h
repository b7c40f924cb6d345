/* glyphs.h - overlay: draws text in a finished picture, with a bitmap font of ASCII and the characters of units:
 * degree, plus-minus, superscripts 1 2 3 and minus, micro, middle dot, times, minus, and some Greek letters.
 *
 * Capitals and digits are five dots wide and seven high; no glyph is wider, and two rows below hold descenders. A dot
 * is `scale` pixels wide and high. A character without a glyph is drawn as an empty box. Texts are UTF-8. */
#ifndef ZR_GLYPHS_H
#define ZR_GLYPHS_H

#include <stdbool.h>

#include "overlay/canvas.h"

enum { ZR_GLYPH_ROWS = 9, ZR_GLYPH_CAPITAL_ROWS = 7 };

/* Returns the width in dots, from the first to the last column of the text; 0 if it is empty. */
int32_t zr_glyphs_width(const char *text);

/* Returns false if some character has no glyph. */
bool zr_glyphs_has_all(const char *text);

/* Draws text with the upper left corner of the first capital at pixel (x, y). `grow` enlarges each dot by that many
 * pixels on all sides: text drawn grown in one colour, and again not grown in another, is legible on every
 * background. */
void zr_glyphs_draw(const struct zr_canvas *canvas, const char *text, int32_t x, int32_t y, int32_t scale, int32_t grow,
                    uint32_t color);

#endif
