/* post.h - client: sends a request to the server and receives the answer. */
#ifndef POST_H
#define POST_H

#include "answer.h"
#include "files/input.h"
#include "token.h"

/* Loads libcurl. Returns 0, or the exit status of a failure reported on stderr. */
int post_open(void);
void post_close(void);

/* Sends the file and its parts. Fills the answer, also with the reason if the server refuses or cannot be reached.
 * Thread-safe. */
void post(const char *server, const struct token *token, const struct input *input, const char *query,
          struct answer *answer);

#endif
