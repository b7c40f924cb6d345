/* log.h - the log: one JSON line per request, on standard error (log_writer.h).
 *
 * Text from clients is untrusted: it becomes valid UTF-8, bounded and escaped.
 */
#ifndef ZRASTERD_LOG_H
#define ZRASTERD_LOG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "step_times.h"

/* Empty texts (NULL or "") are omitted. */
struct log_request {
    const char *id, *remote, *method, *path, *query, *traceparent, *detail;
    const char *route; /* its path in the table of routes; NULL: none was found */
    const char *look;  /* with its version, as answered: "studio@2" */
    size_t warnings;   /* of the answer */
    int status;        /* 0: no answer was sent */
    bool aborted;
    uint64_t bytes_in, bytes_out;
    double total_ms;
    struct step_times times;
};

void log_request(const struct log_request *request);

/* Logs a line about the daemon itself. */
void log_event(const char *level, const char *event, const char *detail);

/* Returns true for a well-formed W3C trace context: 00-<32 hex>-<16 hex>-<2 hex>. */
bool log_is_traceparent(const char *text);

#endif
