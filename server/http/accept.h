/* accept.h - content negotiation (RFC 9110, 12.5.1): several files as an archive, or in parts; metrics. */
#ifndef ZRASTERD_ACCEPT_H
#define ZRASTERD_ACCEPT_H

#include <stdbool.h>

#define ACCEPT_MIXED_TYPE "multipart/mixed"
#define ACCEPT_FORM_TYPE  "multipart/form-data"
#define ACCEPT_OPEN_TYPE  "application/openmetrics-text"

/* Thousandths of the weights of types that a request names; 0: not named. Starts as {0}. Wildcards are ignored. */
struct accept {
    int mixed, form, zip, open_metrics, plain;
};

/* Reads the value of an Accept header. A request may have several. */
void accept_read(struct accept *accept, const char *value);

enum accept_parts { ACCEPT_NO_PARTS, ACCEPT_MIXED, ACCEPT_FORM };

/* Returns the type of parts that the client named with the highest weight, multipart/mixed before multipart/form-data;
 * none if it prefers application/zip. */
enum accept_parts accept_parts(const struct accept *accept);

/* Returns true if the client named OpenMetrics, and not text/plain with a higher weight. */
bool accept_open_metrics(const struct accept *accept);

#endif
