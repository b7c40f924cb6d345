/* nearest.h - input: finds the known word nearest to a misspelt one.
 *
 *     struct zr_nearest nearest = {.word = "zNear"};
 *     for each known word: zr_nearest_offer(&nearest, known);
 *     ... zr_nearest_text(&nearest).text
 */
#ifndef ZR_NEAREST_H
#define ZR_NEAREST_H

#include <stddef.h>

struct zr_nearest {
    const char *word;  /* the misspelt word */
    const char *known; /* the nearest known word so far; NULL if none is near */
    size_t distance, offers;
};

/* Compares a known word by edit distance: letters left out, added, changed or swapped with the next. A word is near at
 * a distance of 1 or 2, less for short words, or if it begins with the misspelt one, of three letters or more. Case,
 * '_' and '-' do not count: base_color_factor equals baseColorFactor. Ignores words after the first thousand. */
void zr_nearest_offer(struct zr_nearest *nearest, const char *known);

/* Formats " (did you mean WORD?)", or "". */
struct zr_nearest_text {
    char text[64];
};
struct zr_nearest_text zr_nearest_text(const struct zr_nearest *nearest);

#endif
