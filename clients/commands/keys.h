/* keys.h - client: help for keys of scenes and their values, from the library's schema and tables. */
#ifndef KEYS_H
#define KEYS_H

#include <stdbool.h>

#include "options/words.h"

/* Explains a key ("znear", "view.znear") or a word that is a value ("nocs"), or lists the keys of an object ("light").
 * False: the name is unknown. */
bool keys_explain(const char *name);

/* Offers all names of keys, objects and words. near->best may point to static memory. */
void keys_offer(struct near_word *near);

#endif
