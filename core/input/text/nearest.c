#include "input/text/nearest.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* OFFERS_MAX: a scene may have any number of names, and each comparison takes microseconds. */
enum { LETTERS_MAX = 40, OFFERS_MAX = 1000, DISTANCE_MAX = 2, BEGIN_MIN = 3 };

/* Copies a word without '_' and '-', in lower case. Returns its length, or LETTERS_MAX + 1 if it is longer. */
static size_t fold(const char *word, char out[LETTERS_MAX])
{
    size_t count = 0;
    for (; *word; word++) {
        if (*word == '_' || *word == '-') continue;
        if (count == LETTERS_MAX) return LETTERS_MAX + 1;
        out[count++] = *word >= 'A' && *word <= 'Z' ? (char)(*word + ('a' - 'A')) : *word;
    }
    return count;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Returns the distance by optimal alignment. Source: Damerau, "A technique for computer detection and correction of
 * spelling errors", 1964. */
static size_t distance_of(const char *a, size_t a_count, const char *b, size_t b_count)
{
    size_t rows[3][LETTERS_MAX + 1], *before = rows[0], *last = rows[1], *row = rows[2];
    for (size_t k = 0; k <= b_count; k++)
        before[k] = last[k] = k;
    for (size_t i = 1; i <= a_count; i++) {
        row[0] = i;
        for (size_t k = 1; k <= b_count; k++) {
            row[k] = least(last[k - 1] + (a[i - 1] != b[k - 1]), least(last[k], row[k - 1]) + 1);
            if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
                row[k] = least(row[k], before[k - 2] + 1);
        }
        size_t *oldest = before;
        before = last;
        last = row;
        row = oldest;
    }
    return last[b_count];
}

/* Returns the distance of a near word, or SIZE_MAX. A word that continues the misspelt one by two letters or more is
 * farther than all others. */
static size_t nearness(const char *a, size_t a_count, const char *b, size_t b_count)
{
    if (a_count >= BEGIN_MIN && a_count < b_count && memcmp(a, b, a_count) == 0)
        return b_count - a_count + (b_count - a_count > 1 ? DISTANCE_MAX : 0);
    if (a_count > b_count + DISTANCE_MAX || b_count > a_count + DISTANCE_MAX) return SIZE_MAX;
    const size_t distance = distance_of(a, a_count, b, b_count);
    return distance > least(DISTANCE_MAX, (b_count - 1) / 3) ? SIZE_MAX : distance;
}

void zr_nearest_offer(struct zr_nearest *nearest, const char *known)
{
    char a[LETTERS_MAX], b[LETTERS_MAX];
    if (nearest->offers++ >= OFFERS_MAX) return;
    const size_t a_count = fold(nearest->word, a), b_count = fold(known, b);
    if (a_count > LETTERS_MAX || b_count > LETTERS_MAX || a_count == 0) return;
    const size_t distance = b_count > 0 ? nearness(a, a_count, b, b_count) : SIZE_MAX;
    if (distance == SIZE_MAX || (nearest->known && distance >= nearest->distance)) return;
    nearest->known = known;
    nearest->distance = distance;
}

struct zr_nearest_text zr_nearest_text(const struct zr_nearest *nearest)
{
    struct zr_nearest_text out = {""};
    if (nearest->known) snprintf(out.text, sizeof out.text, " (did you mean %s?)", nearest->known);
    return out;
}
