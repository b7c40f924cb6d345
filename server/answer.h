/* answer.h - what goes back to a client: status, headers, bytes.
 *
 * Owns its bytes, its file and the values of its headers. Starts as {0}; status 0 means
 * that there is no answer yet.
 */
#ifndef ZRASTERD_ANSWER_H
#define ZRASTERD_ANSWER_H

#include <stdbool.h>
#include <stddef.h>

enum { ANSWER_HEADERS_MAX = 12, ANSWER_DETAIL_SIZE = 640 };

struct answer_header {
    const char *name; /* of static lifetime */
    char *value;      /* malloc'd */
};

struct answer {
    int status;
    bool close;     /* the connection ends after this */
    bool is_broken; /* a header or a field could not be made: what there is must not go out */
    char *bytes;    /* NULL: none are sent, or those of `file` */
    int file;       /* open, to be sent from its beginning; 0: none */
    size_t size;    /* without bytes: as Content-Length tells it, to HEAD and with 304 */
    size_t header_count;
    struct answer_header headers[ANSWER_HEADERS_MAX];
    char detail[ANSWER_DETAIL_SIZE]; /* of an error, for the log; valid UTF-8 */
};

/* The reason phrase of an HTTP status (RFC 9110, 15). */
const char *answer_reason(int status);

/* Makes it the one answer that needs no memory: a 503, of which answer_send has the bytes ready. */
void answer_to_no_memory(struct answer *answer);

/* Adds a header. */
void answer_header(struct answer *answer, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Hands `bytes` (malloc'd) over to the answer. */
void answer_body(struct answer *answer, const char *content_type, char *bytes, size_t size);

/* 200 with a copy of the bytes, since the arena they lie in is needed for the next request. */
void answer_copy(struct answer *answer, const char *content_type, const void *bytes, size_t size);

/* Hands an open file over to the answer. */
void answer_file(struct answer *answer, const char *content_type, int file, size_t size);

/* From now on only the length is told, as to HEAD. */
void answer_drop_bytes(struct answer *answer);

/* Writes the whole answer, or, where it is broken, that there is no memory, to a socket, as HTTP/1.1 with Connection:
 * close, as far as it goes without waiting. */
void answer_send(const struct answer *answer, int socket_fd);

void answer_free(struct answer *answer);

#endif
