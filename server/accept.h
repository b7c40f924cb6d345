/* accept.h - content negotiation (RFC 9110, 12.5.1): an answer in one piece, or a stream. */
#ifndef ZRASTERD_ACCEPT_H
#define ZRASTERD_ACCEPT_H

#include <stdbool.h>

/* Thousandths of the weights of types that a request names; 0: not named. Starts as {0}. Wildcards are ignored. */
struct accept {
    int mixed, zip;
};

/* Reads the value of an Accept header. A request may have several. */
void accept_read(struct accept *accept, const char *value);

/* Returns true if the client named multipart/mixed, and does not prefer application/zip. */
bool accept_wants_stream(const struct accept *accept);

#endif
