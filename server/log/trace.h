/* trace.h - the trace of a request (W3C Trace Context): the caller's ids, and one of the daemon's own. Pure. */
#ifndef ZRASTERD_TRACE_H
#define ZRASTERD_TRACE_H

#include <stdbool.h>
#include <stdint.h>

enum { TRACE_ID_SIZE = 33, TRACE_SPAN_SIZE = 17, TRACE_PARENT_SIZE = 56 };

/* All empty: the request belongs to no trace. */
struct trace {
    char id[TRACE_ID_SIZE];         /* of the trace */
    char parent[TRACE_SPAN_SIZE];   /* span of the caller */
    char span[TRACE_SPAN_SIZE];     /* of this request */
    char given[TRACE_PARENT_SIZE];  /* the header up to its flags */
    char answer[TRACE_PARENT_SIZE]; /* value of traceresponse */
    bool is_sampled;
};

/* Reads a value of traceparent: of version 00, and of later ones the part that they share. `unique` becomes the id of
 * the span: it differs for each request. False, and the trace is empty: the header is malformed and thus ignored. */
bool trace_read(struct trace *trace, const char *traceparent, uint64_t unique);

#endif
