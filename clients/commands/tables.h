/* tables.h - client: looks, channels and limits of the library. */
#ifndef TABLES_H
#define TABLES_H

#include "options/options.h"
#include "options/words.h"

/* Adds the names of looks, such as "studio". */
void tables_looks(struct words *words);

/* Returns the ending of a channel's file; `encoding` may be "": the channel's first one. NULL: there is no such
 * channel, or it lacks this encoding. */
const char *tables_extension(const char *channel, const char *encoding);

struct parameter_row; /* options/parameters.h */

/* Adds the values that a parameter accepts, as far as they are words. */
void tables_values(struct words *words, const struct parameter_row *parameter);

/* Prints the meaning of a word ("nocs", "studio@1"), or those of all words of a kind ("channel", "channels"). Returns
 * false for other names. */
bool tables_explain(const char *name);

/* Offers all words that tables_explain knows. */
void tables_offer(struct near_word *near);

/* Opens and closes the tables. The functions above open them if needed, and are thread-safe once they are open. */
void tables_open(void);
void tables_close(void);

#endif
