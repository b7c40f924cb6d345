/* letter_table.h - overlay: the strokes of each letter, as text.
 *
 * Space:   units of a tenth of the height of capitals; x to the right from the left end of the letter, y upwards from
 *          the base line. Small letters without ascender are 7 high; descenders end at -3, accents of capitals at 14.4.
 * Strokes: numbers "x y x y ..." are the points of a polyline. "/" begins the next one.
 *          "o x y rx ry from to" adds points of an ellipse, its centre, radii and angles in degrees, against the clock
 *          if from < to: a point per 15 degrees at least.
 *          "d x y" is a dot: a square with sides of 0.7, so that it is 1.6 strokes wide.
 *          "=C x y scale" is the ASCII letter C, moved and scaled.
 * Source:  the manner of ISO 3098, type B; the forms are our own. */
#ifndef ZR_LETTER_TABLE_H
#define ZR_LETTER_TABLE_H

#include <stdint.h>

/* Rows are sorted by character. */
struct zr_letter_row {
    uint32_t character;
    double width;
    const char *strokes;
};

/* A letter with a mark above it, or below. Both have rows of their own. */
struct zr_accent_row {
    uint32_t character, base, mark;
};

/* The last row, which no character has: a box for characters without a row. */
enum { ZR_LETTER_ROWS = 204, ZR_LETTER_NONE = ZR_LETTER_ROWS - 1, ZR_ACCENT_ROWS = 54 };

extern const struct zr_letter_row zr_letter_rows[ZR_LETTER_ROWS];
extern const struct zr_accent_row zr_accent_rows[ZR_ACCENT_ROWS];

#endif
