/* letters.h - overlay: a font of strokes, in the manner of ISO 3098.
 *
 * Space:  that of letter_table.h: capitals are ten units high, y upwards from the base line.
 * Letters: ASCII and Latin-1; common Greek letters; superscripts and subscripts; signs of engineering drawings and of
 *         typography. Any other character is an empty box. */
#ifndef ZR_LETTERS_H
#define ZR_LETTERS_H

#include <stdbool.h>

#include "overlay/letter_table.h"
#include "overlay/path.h"

/* Height of capitals, and the ends of all letters, without half of the pen: units. */
#define ZR_LETTER_CAPITAL 10.0
#define ZR_LETTER_TOP     14.4
#define ZR_LETTER_BOTTOM  (-3.0)

struct zr_letter {
    const struct zr_letter_row *base, *mark; /* mark: NULL: none */
};

/* Returns the letter of a character, and the box for one without. */
struct zr_letter zr_letter_find(uint32_t character);

/* Returns the width in units: that of the base or of the mark, whichever is larger. */
double zr_letter_width(struct zr_letter letter);

/* Returns false for the box. */
static inline bool zr_letter_is_known(struct zr_letter letter)
{
    return letter.base != &zr_letter_rows[ZR_LETTER_NONE];
}

/* Polylines of a letter; the largest have 62 points, or 5 polylines. */
enum { ZR_LETTER_POINTS = 80, ZR_LETTER_LINES = 8 };

struct zr_letter_path {
    uint32_t count;
    uint32_t ends[ZR_LETTER_LINES];
    struct zr_point points[ZR_LETTER_POINTS];
};

/* Computes the polylines of a letter. A space has none. */
void zr_letter_trace(struct zr_letter letter, struct zr_letter_path *out);

#endif
