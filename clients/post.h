/* post.h - client: one request to the server, and what it answers. */
#ifndef POST_H
#define POST_H

#include <stdbool.h>

#include "bytes.h"
#include "options.h"
#include "token.h"

struct reply {
    struct bytes body;
    long status;
    char type[64];      /* Content-Type, without parameters */
    long retry_seconds; /* when to try again; 0: not said */
};

/* True where an answer came, of whatever status; else stderr says why. Warnings of the server go to stderr as
 * they arrive. */
bool post(const struct options *options, const struct token *token, const struct bytes *body, struct reply *reply);

#endif
