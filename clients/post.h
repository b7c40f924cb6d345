/* post.h - client: sends one request to the server and receives the answer. */
#ifndef POST_H
#define POST_H

#include <stdbool.h>

#include "bytes.h"
#include "options.h"
#include "token.h"

struct reply {
    struct bytes body;
    long status;
    char type[64];      /* Content-Type without parameters */
    long retry_seconds; /* until the next try, from the server; 0: none given */
};

/* True: an answer of any status arrived. False: the reason is on stderr. Prints warnings of the server to stderr on
 * arrival. */
bool post(const struct options *options, const struct token *token, const struct bytes *body, struct reply *reply);

#endif
