/* words.h - client: the values that options accept. */
#ifndef WORDS_H
#define WORDS_H

#include <stddef.h>

#include "mcp/near.h"

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
