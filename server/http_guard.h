/* http_guard.h - refuses requests whose framing two readers could read in two
 * ways, which libmicrohttpd lets through (request smuggling).
 */
#ifndef ZRASTERD_HTTP_GUARD_H
#define ZRASTERD_HTTP_GUARD_H

#include <stdbool.h>
#include <stdint.h>

struct MHD_Connection;

enum { HTTP_URI_MAX = 32768, HTTP_HEADERS_MAX = 32768 };

struct http_framing {
    int status; /* 0: fine, else the refusal's */
    const char *detail;
    bool is_chunked, expects_continue;
    uint64_t length;
};

/* Call in the first callback of a request. A NUL or a bare LF within the header
 * cannot be seen from here; a proxy in front refuses those. */
struct http_framing http_guard_check(struct MHD_Connection *connection, const char *version, const char *target);

#endif
