#include "http_guard.h"

#include <string.h>
#include <strings.h>

#include <microhttpd.h>

struct headers {
    size_t bytes, hosts, lengths, encodings, expects;
    const char *length, *encoding, *expect;
    bool bad_name, bad_value;
};

/* RFC 9110, 5.6.2 */
static bool is_token(const char *text, size_t size)
{
    static const char SYMBOLS[] = "!#$%&'*+-.^_`|~";
    for (size_t i = 0; i < size; i++) {
        char c = text[i];
        bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (!letter && (c == '\0' || !strchr(SYMBOLS, c))) return false;
    }
    return size > 0;
}

static bool is_field_value(const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        unsigned char c = (unsigned char)text[i];
        if ((c < ' ' && c != '\t') || c == 0x7F) return false;
    }
    return true;
}

static enum MHD_Result take_header(void *context, enum MHD_ValueKind kind, const char *name, size_t name_size,
                                   const char *value, size_t value_size)
{
    struct headers *headers = context;
    (void)kind;
    if (!value) value = "";
    headers->bytes += name_size + value_size + 4; /* ": " and CRLF */
    headers->bad_name |= !is_token(name, name_size);
    headers->bad_value |= !is_field_value(value, value_size);
    if (strcasecmp(name, "Host") == 0) headers->hosts++;
    if (strcasecmp(name, "Content-Length") == 0) {
        headers->lengths++;
        headers->length = value;
    }
    if (strcasecmp(name, "Transfer-Encoding") == 0) {
        headers->encodings++;
        headers->encoding = value;
    }
    if (strcasecmp(name, "Expect") == 0) {
        headers->expects++;
        headers->expect = value;
    }
    return MHD_YES;
}

static bool parse_length(const char *text, uint64_t *out)
{
    uint64_t value = 0;
    for (const char *p = text; *p; p++)
        if (*p < '0' || *p > '9' || __builtin_mul_overflow(value, 10u, &value) ||
            __builtin_add_overflow(value, (uint64_t)(*p - '0'), &value))
            return false;
    *out = value;
    return *text != '\0';
}

struct http_framing http_guard_check(struct MHD_Connection *connection, const char *version, const char *target)
{
    struct headers headers = {0};
    MHD_get_connection_values_n(connection, MHD_HEADER_KIND, take_header, &headers);
    /* HTTP/1.0 knows no Host; the health checks of some load balancers send none. */
    bool is_old = strcmp(version, "HTTP/1.0") == 0;
    bool host_ok = headers.hosts == 1 || (is_old && headers.hosts == 0);
    struct http_framing framing = {.is_chunked = headers.encodings == 1};

    if (strlen(target) > HTTP_URI_MAX)
        framing.status = 414, framing.detail = "the URI is longer than 32768 bytes";
    else if (strchr(target, ' '))
        framing.status = 400, framing.detail = "the URI has a space in it";
    else if (headers.bytes > HTTP_HEADERS_MAX)
        framing.status = 431, framing.detail = "the header is larger than 32768 bytes";
    else if (headers.bad_name)
        framing.status = 400, framing.detail = "a header's name is not a token";
    else if (headers.bad_value)
        framing.status = 400, framing.detail = "a header's value has control characters";
    else if (!host_ok)
        framing.status = 400, framing.detail = "exactly one Host header is needed";
    else if (headers.lengths > 1)
        framing.status = 400, framing.detail = "more than one Content-Length";
    else if (headers.lengths && headers.encodings)
        framing.status = 400, framing.detail = "both Content-Length and Transfer-Encoding";
    else if (headers.lengths && !parse_length(headers.length, &framing.length))
        framing.status = 400, framing.detail = "Content-Length is not a number";
    else if (headers.encodings > 1)
        framing.status = 400, framing.detail = "more than one Transfer-Encoding";
    else if (headers.encodings && is_old)
        framing.status = 400, framing.detail = "Transfer-Encoding in HTTP/1.0";
    else if (headers.encodings && strcasecmp(headers.encoding, "chunked") != 0)
        framing.status = 501, framing.detail = "the only Transfer-Encoding that is known is chunked";
    else if (headers.expects && (headers.expects > 1 || strcasecmp(headers.expect, "100-continue") != 0))
        framing.status = 417, framing.detail = "the only expectation that is known is 100-continue";
    framing.expects_continue = headers.expects > 0 && framing.status == 0;
    return framing;
}
