/* framing.h - finds the ends of requests in the bytes of a connection, and refuses malformed ones.
 *
 * Two readers of one stream must see the same requests; otherwise a client can smuggle a second request past one of
 * them (RFC 9112, 11). Versions of libmicrohttpd differ in the requests that they accept, and refuse others with
 * answers of their own, or none. So this scanner gets every byte first, and libmicrohttpd gets the bytes that pass. It
 * checks the request line, control bytes, line ends, chunk lines, limits, and the headers that determine the length of
 * a body. All other bytes pass unread.
 *
 *     framing_scan(&framing, bytes, count)     for all bytes received, in pieces of any size
 *
 * Pure: no sockets. Source of the rules: RFC 9112.
 */
#ifndef ZRASTERD_FRAMING_H
#define ZRASTERD_FRAMING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The part of a request that passes must fit into libmicrohttpd's memory of a connection (http.c), with 64 bytes per
 * header line beside its text. Above 32 KiB it would map and unmap that memory, which takes longer than refusing a
 * request. */
enum {
    FRAMING_TARGET_MAX = 8192,   /* bytes of a request target */
    FRAMING_PARAMETERS_MAX = 64, /* '&' in it: room for all of parameter_rows.h */
    FRAMING_HEADERS_MAX = 32768, /* bytes of all header lines with their ends; the same for trailer lines */
    FRAMING_FIELDS_MAX = 100,    /* header lines */
    FRAMING_NAME_MAX = 64,       /* bytes of a header's name */
    FRAMING_VALUES_MAX = 4096,   /* bytes of all values that pass */
    FRAMING_METHOD_MAX = 23,
    FRAMING_EMPTY_MAX = 16,      /* empty lines before a request */
    FRAMING_EXTENSION_MAX = 1024 /* bytes after the ';' of a chunk line */
};

/* Part of a request that the next byte belongs to. */
enum framing_state {
    FRAMING_START, /* between requests */
    FRAMING_EMPTY_LF,
    FRAMING_METHOD,
    FRAMING_TARGET,
    FRAMING_VERSION,
    FRAMING_LINE_LF, /* after the CR of the request line */
    FRAMING_FIELD,   /* first byte of a header line */
    FRAMING_NAME,
    FRAMING_VALUE,
    FRAMING_VALUE_LF,
    FRAMING_HEADER_LF, /* last byte of a header */
    FRAMING_BODY,
    FRAMING_CHUNK_SIZE,
    FRAMING_CHUNK_EXTENSION,
    FRAMING_CHUNK_LF,
    FRAMING_CHUNK_DATA,
    FRAMING_CHUNK_DATA_CR,
    FRAMING_CHUNK_DATA_LF,
    FRAMING_REFUSED
};

enum { FRAMING_WORD_SIZE = 24 }; /* room for each name and value that is compared, and one byte more for longer ones */

/* Starts as {0}, but for reads_client. The last four members are the result. */
struct framing {
    bool reads_client; /* the headers pass in which proxies name their clients */
    enum framing_state state;
    bool is_trailer, is_old, is_chunked; /* is_old: HTTP/1.0 */
    uint32_t line_bytes;                 /* of the current method, target, name, value, chunk size or extension */
    uint32_t empty_lines, header_bytes, fields, parameters, values_bytes;
    bool is_read, is_exact;             /* of the current header: its value passes; is_exact: without any space */
    bool is_dropped;                    /* the last byte does not pass */
    uint32_t seen;                      /* headers of the table of framing.c, a bit for each */
    uint32_t known;                     /* row of the current header in that table, or its length */
    uint64_t left;                      /* bytes of the body or the chunk */
    uint32_t name_length, value_length; /* of the words; values without trailing space */
    char name[FRAMING_WORD_SIZE], value[FRAMING_WORD_SIZE]; /* of the current header, in lower case, cut */
    int wrong_status;
    const char *wrong; /* first fault in the headers, reported at their end */

    uint64_t passed;    /* requests whose complete header has passed */
    int status;         /* of the refusal; 0: none. After a refusal no byte passes */
    const char *detail; /* of the refusal */
    bool refused_body;  /* the refused bytes belong to a request whose header has passed before */
};

/* Scans `size` bytes, moves those that pass to the front of `bytes` and returns their count. On a refusal they end with
 * the last complete request. */
size_t framing_scan(struct framing *framing, char *bytes, size_t size);

/* Refuses the bytes from here on for a reason that the scanner does not know. */
void framing_refuse(struct framing *framing, int status, const char *detail);

/* Returns true if a request's header has begun and not ended. */
static inline bool framing_is_within_header(const struct framing *framing)
{
    return framing->state > FRAMING_EMPTY_LF && framing->state < FRAMING_BODY && !framing->is_trailer;
}

/* Returns true if no request has begun, or all that began are complete. */
static inline bool framing_is_between(const struct framing *framing)
{
    return framing->state <= FRAMING_EMPTY_LF;
}

#endif
