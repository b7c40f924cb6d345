/* nearest.h - input: which known word was probably meant.
 *
 *     struct zr_nearest nearest = {.word = "zNear"};
 *     for each word that is known: zr_nearest_offer(&nearest, known);
 *     ... zr_nearest_text(&nearest).text
 */
#ifndef ZR_NEAREST_H
#define ZR_NEAREST_H

#include <stddef.h>

struct zr_nearest {
    const char *word;  /* as it was written */
    const char *known; /* the nearest one so far; NULL where none is near */
    size_t distance, offers;
};

/* Letters left out, too many, changed or swapped with the next: one or two of them, few enough for the word's length.
 * Case, '_' and '-' do not count, so that base_color_factor is baseColorFactor. After a thousand
 * words no more are looked at. */
void zr_nearest_offer(struct zr_nearest *nearest, const char *known);

/* " (did you mean WORD?)", or "". */
struct zr_nearest_text {
    char text[64];
};
struct zr_nearest_text zr_nearest_text(const struct zr_nearest *nearest);

#endif
