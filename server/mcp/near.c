#include "near.h"

#include <string.h>

enum { LENGTH_MAX = 40 };

static size_t least(size_t a, size_t b, size_t c)
{
    const size_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}

/* Counts characters to insert, remove, replace or swap. */
static size_t distance_of(const char *a, const char *b)
{
    size_t rows[3][LENGTH_MAX + 1];
    const size_t n = strlen(a), m = strlen(b);
    if (n > LENGTH_MAX || m > LENGTH_MAX) return LENGTH_MAX;
    for (size_t j = 0; j <= m; j++)
        rows[0][j] = j;
    for (size_t i = 1; i <= n; i++) {
        size_t *row = rows[i % 3];
        const size_t *before = rows[(i + 2) % 3], *earlier = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= m; j++) {
            row[j] = least(before[j] + 1, row[j - 1] + 1, before[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least(row[j], row[j], earlier[j - 2] + 1);
        }
    }
    return rows[n % 3][m];
}

void near_offer(struct near_word *near, const char *candidate)
{
    const size_t distance = distance_of(near->word, candidate), length = strlen(near->word);
    if (distance > (length < 3 ? 0 : length < 6 ? 1 : length / 3)) return;
    if (near->best && distance >= near->distance) return;
    near->best = candidate;
    near->distance = distance;
}
