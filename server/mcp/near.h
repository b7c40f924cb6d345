/* near.h - mcp, client: suggestions for misspelt words. */
#ifndef NEAR_H
#define NEAR_H

#include <stddef.h>

/* The word of a list that is nearest to a given one; `best` is NULL if none is near. */
struct near_word {
    const char *word, *best;
    size_t distance;
};
void near_offer(struct near_word *near, const char *candidate);

#endif
