/* answer.h - the answer to a request: status, headers, bytes.
 *
 * Owns its bytes, unless they are lent, its file and the values of its headers. Starts as {0}; status 0: no answer yet.
 */
#ifndef ZRASTERD_ANSWER_H
#define ZRASTERD_ANSWER_H

#include <stdbool.h>
#include <stddef.h>

#include "base/status.h"
#include "refusal.h"

/* A detail: one of the core, and what is before it. */
enum { ANSWER_HEADERS_MAX = 32, ANSWER_DETAIL_SIZE = ZR_DETAIL_SIZE + 160 };

struct answer_header {
    const char *name; /* static lifetime */
    char *value;      /* malloc'd */
};

struct kept;
struct kept_held;
struct answer_bytes;

struct answer {
    int status;
    enum refusal refusal; /* of a 503 or 429 */
    bool close;           /* close the connection after this answer */
    bool is_plain;        /* an error is text/plain (problem.h) */
    bool is_broken;       /* memory ran out for a header or a field: the answer must not be sent */
    char *bytes;          /* body; NULL: none, or that of `file` */
    int file;             /* open file, sent from its beginning; 0: none */
    size_t size;          /* of the body; without bytes (HEAD, 304) the value of Content-Length only */
    bool is_unsized;      /* HEAD, 304: there is no Content-Length, since the size is not known */
    /* Bytes that are lent (keep/answers.h) or shared: gives them back. NULL: they are malloc'd. */
    void (*release)(struct answer *answer);
    struct kept *lender;
    struct kept_held *lent;
    struct answer_bytes *shared; /* NULL: they are not shared */
    size_t header_count;
    struct answer_header headers[ANSWER_HEADERS_MAX];
    size_t warnings;                 /* of the render, for the log */
    char detail[ANSWER_DETAIL_SIZE]; /* text of an error for the log, valid UTF-8 */
};

/* Returns the reason phrase of an HTTP status (RFC 9110, 15). */
const char *answer_reason(int status);

/* Turns the answer into a 503 that needs no memory; answer_send has its bytes ready. */
void answer_to_no_memory(struct answer *answer);

/* Adds a header. Sets is_broken if memory or places run out. */
void answer_header(struct answer *answer, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Returns the value of a header, NULL if the answer does not have it. */
const char *answer_find(const struct answer *answer, const char *name);

/* Adds the name of a header of requests to Vary, unless it is there. */
void answer_vary(struct answer *answer, const char *name);

/* Sets the body. Takes ownership of `bytes` (malloc'd). */
void answer_body(struct answer *answer, const char *content_type, char *bytes, size_t size);

/* Sets status 200 and a copy of the bytes, since the next request reuses their arena. */
void answer_copy(struct answer *answer, const char *content_type, const void *bytes, size_t size);

/* Makes `other`, empty, an answer with the same status, headers and bytes, which both share, but without its
 * Server-Timing. One thread must free all that share. False without memory, or if the bytes are lent. */
bool answer_share(struct answer *answer, struct answer *other);

/* Sets the body to an open file and takes ownership of it. */
void answer_file(struct answer *answer, const char *content_type, int file, size_t size);

/* Drops the body and keeps its size, as for HEAD. */
void answer_drop_bytes(struct answer *answer);

/* Writes the answer to a socket as HTTP/1.1 with Connection: close, without waiting; bytes that do not fit are lost. A
 * broken answer becomes a 503. */
void answer_send(const struct answer *answer, int socket_fd);

void answer_free(struct answer *answer);

#endif
