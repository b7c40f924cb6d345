/* token.h - client: the token that a server may want. It is neither taken from the command line nor ever shown. */
#ifndef TOKEN_H
#define TOKEN_H

#include <stdbool.h>

enum { TOKEN_SIZE = 4096 };

struct token {
    char text[TOKEN_SIZE]; /* "": none */
    const char *from;      /* where it comes from, for messages */
};

/* The first line of `path`; where that is NULL, the variable ZRASTER_TOKEN. False, and stderr says why, where a
 * file cannot be read or what is in it is no token. */
bool token_read(struct token *token, const char *path);

#endif
