/* tables.h - client: looks, channels and limits of the library. */
#ifndef TABLES_H
#define TABLES_H

#include "options.h"
#include "words.h"

/* Adds the names of looks, such as "studio". */
void tables_looks(struct words *words);

/* Returns the ending of a channel's file; `encoding` may be "": the channel's first one. NULL: there is no such
 * channel, or it has not this encoding. */
const char *tables_extension(const char *channel, const char *encoding);

/* Adds the values that a parameter takes, as far as they are words. */
void tables_values(struct words *words, enum parameter parameter);

/* Opens and closes the tables. Opened once, any number of threads may call the functions above. */
void tables_open(void);
void tables_close(void);

#endif
