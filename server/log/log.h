/* log.h - the log: one JSON line per request, on standard error (log_writer.h).
 *
 * Text from clients is untrusted: log_text.h makes it safe. A line has at most LOG_LINE_SIZE bytes.
 */
#ifndef ZRASTERD_LOG_H
#define ZRASTERD_LOG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "refusal.h"
#include "trace.h"

/* Durations of the steps of a request, in ms. predicted_ms: predicted processor time of render and encode. Below 0: the
 * step was not reached. */
struct step_times {
    double parse_ms, queue_ms, render_ms, encode_ms, predicted_ms;
};
#define NO_STEP_TIMES ((struct step_times){-1, -1, -1, -1, -1})

/* Room for all texts of a request, each byte escaped to six. */
enum { LOG_LINE_SIZE = 32 << 10 };

/* Empty texts (NULL or "") are omitted. */
struct log_request {
    const char *id, *method, *path, *query, *detail;
    const char *remote;                  /* address of the other end of the connection */
    const char *client;                  /* address of the client, as a trusted proxy told it; else that of `remote` */
    const struct trace *trace;           /* NULL: none */
    const char *route;                   /* its path in the table of routes; NULL: none was found */
    const char *look;                    /* with its version, as answered: "studio@1" */
    size_t warnings;                     /* of the answer */
    int status;                          /* 0: no answer was sent */
    enum refusal refusal;                /* of a 503 or 429 */
    bool aborted, client_left, was_slow; /* the answer did not arrive whole; its client left, or read it too slowly */
    uint64_t bytes_in, bytes_out;
    double total_ms;
    struct step_times times;
};

void log_request(const struct log_request *request);

/* Logs a line about the daemon itself. */
void log_event(const char *level, const char *event, const char *detail);

#endif
