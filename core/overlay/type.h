/* type.h - overlay: text of strokes, in a finished picture or as polylines.
 *
 * Space:  pixels, y downwards. A text has a height, that of the middle lines of capitals, and begins at the left end of
 *         the first letter's middle lines on the base line. Ink is half of the pen's width wider on all sides.
 * Sizes:  letters are 0.24 of the height apart. All digits are 0.6 of it wide, so that numbers align.
 * Text:   UTF-8. An invalid byte counts as a character without a letter: an empty box. */
#ifndef ZR_TYPE_H
#define ZR_TYPE_H

#include "overlay/canvas.h"
#include "overlay/letters.h"

/* Below this height, pixels, letters are hard to read. */
#define ZR_TYPE_LEAST 7.0

/* Returns the usual height in a picture of these sides: 11 at 480 pixels, growing with the power 3/4 of the shorter
 * side; whole pixels, so that base lines and capitals are sharp. */
double zr_type_height(int32_t width, int32_t height);

/* Returns the width of the pen for a height: 0.12 of it, at least a pixel. */
double zr_type_pen(double height);

/* Returns the width of a text, from the first to the last middle line; 0 if it is empty. Texts wider than any window
 * are measured in part. */
double zr_type_width(const char *text, double height);

/* Returns false if some character has no letter. */
bool zr_type_has_all(const char *text);

/* Returns the next character of a text that is not at its end, and advances it; U+FFFD for an invalid byte. */
uint32_t zr_type_character(const char **text);

/* Place of a text. (dx, dy): unit vector in which it runs. */
struct zr_type_place {
    double x, y, height, dx, dy;
};

/* What is left of a text, and where. */
struct zr_type_walk {
    const char *text;
    struct zr_type_place place;
};

/* Computes the polylines of the next letter and advances. Returns false at the end of the text. */
bool zr_type_next(struct zr_type_walk *walk, struct zr_letter_path *out);

/* Draws a text with a pen of that width, a colour being four bytes as base/rgba.h makes them. For a halo, draw it first
 * with a wider pen in the colour of the background. */
void zr_type_draw(const struct zr_canvas *canvas, const char *text, struct zr_type_place place, double pen,
                  uint32_t color);

#endif
