/* words.h - client: near misses, and the values that options accept. */
#ifndef WORDS_H
#define WORDS_H

#include <stddef.h>

/* The word of a list that is nearest to a given one; `best` is NULL if none is near. */
struct near_word {
    const char *word, *best;
    size_t distance;
};
void near_offer(struct near_word *near, const char *candidate);

enum { WORDS_MAX = 64, WORDS_SIZE = 1024 };
struct words {
    size_t count, used;
    const char *list[WORDS_MAX]; /* into `text` */
    char text[WORDS_SIZE];
};
void words_add(struct words *words, const char *word, size_t length);

/* Adds the values that a text of help lists: "side of the camera: front, back or top (default: front)". Items of more
 * than one word are left out. */
void words_of_help(struct words *words, const char *help);

#endif
