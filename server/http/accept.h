/* accept.h - content negotiation (RFC 9110, 12.5.1): several files as an archive, or in parts; the
 * form of metrics and of depths. */
#ifndef ZRASTERD_ACCEPT_H
#define ZRASTERD_ACCEPT_H

#include <stdbool.h>

#define ACCEPT_MIXED_TYPE "multipart/mixed"
#define ACCEPT_FORM_TYPE  "multipart/form-data"
#define ACCEPT_OPEN_TYPE  "application/openmetrics-text"

enum accept_type {
    ACCEPT_TYPE_MIXED,
    ACCEPT_TYPE_FORM,
    ACCEPT_TYPE_ZIP,
    ACCEPT_TYPE_OPEN_METRICS,
    ACCEPT_TYPE_PLAIN,
    ACCEPT_TYPE_TIFF,
    ACCEPT_TYPE_PNG,
    ACCEPT_TYPES
};

/* Thousandths of the weights of types that a request names; 0: not named. Starts as {0}. Wildcards are ignored. */
struct accept {
    int weights[ACCEPT_TYPES];
};

/* Reads the value of an Accept header. A request may have several. */
void accept_read(struct accept *accept, const char *value);

enum accept_parts { ACCEPT_NO_PARTS, ACCEPT_MIXED, ACCEPT_FORM };

/* Returns the type of parts that the client named with the highest weight, multipart/mixed before multipart/form-data;
 * none if it prefers application/zip. */
enum accept_parts accept_parts(const struct accept *accept);

/* Returns true if the client named a type, and not the other one with a higher weight. */
bool accept_prefers(const struct accept *accept, enum accept_type type, enum accept_type other);

#endif
