/* token.h - client: the token for the server. Never read from the command line, never printed. */
#ifndef TOKEN_H
#define TOKEN_H

#include <stdbool.h>

enum { TOKEN_SIZE = 4096 };

struct token {
    char text[TOKEN_SIZE]; /* "": none */
    const char *from;      /* its origin, for messages */
};

/* Reads the first line of `path`, or ZRASTER_TOKEN if that is NULL. False, with the reason on stderr: the file cannot
 * be read, or the text is no token. */
bool token_read(struct token *token, const char *path);

#endif
