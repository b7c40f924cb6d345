/* framing.h - where requests begin and end in the bytes of a connection, and which of them are refused.
 *
 * Two readers of one stream must see the same requests, or one smuggles a second request past the other
 * (RFC 9112, 11). What libmicrohttpd lets pass differs from version to version, and what it refuses it
 * answers in its own words, or not at all. So every byte goes through here before it is parsed: request line,
 * control bytes, line ends, chunk lines, the headers that say how long a body is, and limits. All else is passed on
 * unread.
 *
 *     framing_scan(&framing, bytes, count)     for whatever has come, in pieces of any size
 *
 * Pure: knows no sockets. RFC 9112 names the rules.
 */
#ifndef ZRASTERD_FRAMING_H
#define ZRASTERD_FRAMING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What libmicrohttpd gets of a request has to fit into the memory that it has for a connection (http.c), with 64 bytes
 * for each header line beside its text; above 32 KiB it would ask the system for that memory, and give it back, which
 * takes longer than to refuse a request. */
enum {
    FRAMING_TARGET_MAX = 8192,   /* bytes of a request target */
    FRAMING_PARAMETERS_MAX = 64, /* '&' in it: room for all of parameter_rows.h */
    FRAMING_HEADERS_MAX = 32768, /* bytes of all header lines, their ends included; of all trailer lines likewise */
    FRAMING_FIELDS_MAX = 100,    /* lines */
    FRAMING_NAME_MAX = 64,       /* bytes of a header's name */
    FRAMING_VALUES_MAX = 4096,   /* of the values that are passed on, together */
    FRAMING_METHOD_MAX = 23,
    FRAMING_EMPTY_MAX = 16,      /* empty lines before a request */
    FRAMING_EXTENSION_MAX = 1024 /* bytes behind the ';' of a chunk line */
};

/* What the next byte belongs to. */
enum framing_state {
    FRAMING_START, /* between requests */
    FRAMING_EMPTY_LF,
    FRAMING_METHOD,
    FRAMING_TARGET,
    FRAMING_VERSION,
    FRAMING_LINE_LF, /* behind the CR of the request line */
    FRAMING_FIELD,   /* the first byte of a header line */
    FRAMING_NAME,
    FRAMING_VALUE,
    FRAMING_VALUE_LF,
    FRAMING_HEADER_LF, /* the last byte of a header */
    FRAMING_BODY,
    FRAMING_CHUNK_SIZE,
    FRAMING_CHUNK_EXTENSION,
    FRAMING_CHUNK_LF,
    FRAMING_CHUNK_DATA,
    FRAMING_CHUNK_DATA_CR,
    FRAMING_CHUNK_DATA_LF,
    FRAMING_REFUSED
};

enum {
    FRAMING_WORD_SIZE = 24
}; /* room for every name and value that matters here, and a byte to see that there is more */

/* Starts as {0}. The last four are for users. */
struct framing {
    enum framing_state state;
    bool is_trailer, is_old, is_chunked; /* is_old: HTTP/1.0 */
    uint32_t line_bytes; /* of the method, target, name, value, chunk size or its extension, whichever it is */
    uint32_t empty_lines, header_bytes, fields, parameters, values_bytes;
    bool is_read, is_exact; /* the header whose value comes; is_exact: without any space */
    bool is_dropped;        /* the byte that was read last goes no further */
    uint32_t hosts, lengths, encodings, expects, types;
    uint64_t left;                                          /* bytes of the body or the chunk */
    uint32_t name_length, value_length;                     /* of the words; values without trailing space */
    char name[FRAMING_WORD_SIZE], value[FRAMING_WORD_SIZE]; /* of the line, in lower case; cut */
    const char *wrong; /* what is wrong with a header's value, said at the end of the header */

    uint64_t passed;    /* requests whose whole header was passed on */
    int status;         /* of the refusal; 0: none. From then on nothing is passed on */
    const char *detail; /* likewise */
    bool refused_body;  /* likewise: of a request whose header was passed on before */
};

/* Reads `size` bytes, and leaves at `bytes` those of them that are passed on: it returns how many. Where one is refused
 * they end with the last whole request. */
size_t framing_scan(struct framing *framing, char *bytes, size_t size);

/* Some of a request's header has come, and its end has not. */
static inline bool framing_is_within_header(const struct framing *framing)
{
    return framing->state > FRAMING_EMPTY_LF && framing->state < FRAMING_BODY && !framing->is_trailer;
}

/* No byte of a request has come that is not whole. */
static inline bool framing_is_between(const struct framing *framing)
{
    return framing->state <= FRAMING_EMPTY_LF;
}

#endif
