#include "framing.h"

#include <string.h>

enum { CHUNK_DIGITS_MAX = 16 };

static bool is_control(unsigned char c)
{
    return c < ' ' || c == 0x7F;
}

/* RFC 9110, 5.6.2 */
static bool is_token(unsigned char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (c != '\0' && strchr("!#$%&'*+-.^_`|~", c));
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool refuse(struct framing *f, int status, const char *detail)
{
    f->status = status;
    f->detail = detail;
    return false;
}

/* Appends to a word, which keeps its first bytes. A full word equals no known one. */
static void append(char *word, uint32_t *length, char c)
{
    if (*length < FRAMING_WORD_SIZE) word[(*length)++] = lower(c);
}

static bool equals(const char *word, uint32_t length, const char *known)
{
    return strlen(known) == length && memcmp(word, known, length) == 0;
}

/* ---- the request line ---- */

static bool start_request(struct framing *f, char c)
{
    if (c == '\r') { /* RFC 9112, 2.2: some clients send an extra line end */
        if (++f->empty_lines > FRAMING_EMPTY_MAX)
            return refuse(f, 400, "there are too many empty lines before a request");
        f->state = FRAMING_EMPTY_LF;
        return true;
    }
    *f = (struct framing){.reads_client = f->reads_client, .state = FRAMING_METHOD, .passed = f->passed};
    if (!is_token((unsigned char)c))
        return refuse(f, 400,
                      c == 0x16 ? "these bytes look like TLS; this port serves plain HTTP"
                                : "the request line is malformed");
    f->line_bytes = 1;
    return true;
}

/* Begins a part of the request whose bytes are counted. */
static bool enter(struct framing *f, enum framing_state state)
{
    f->state = state;
    f->line_bytes = 0;
    return true;
}

static bool take_method(struct framing *f, char c)
{
    if (c == ' ') return enter(f, FRAMING_TARGET);
    if (!is_token((unsigned char)c)) return refuse(f, 400, "the request line is malformed");
    if (++f->line_bytes > FRAMING_METHOD_MAX) return refuse(f, 501, "the name of the method is too long");
    return true;
}

static bool take_target(struct framing *f, char c)
{
    if (c == ' ' && f->line_bytes > 0) {
        f->state = FRAMING_VERSION;
        return true;
    }
    if (c == ' ') return refuse(f, 400, "the request line is malformed");
    if (c == '\r' || c == '\n') return refuse(f, 400, "the request line has no version");
    if (is_control((unsigned char)c)) return refuse(f, 400, "the URI has control characters");
    if (c == '&' && ++f->parameters > FRAMING_PARAMETERS_MAX)
        return refuse(f, 400, "the query has too many parameters");
    if (++f->line_bytes > FRAMING_TARGET_MAX) return refuse(f, 414, "the URI is longer than 8192 bytes");
    return true;
}

static bool take_version(struct framing *f, char c)
{
    if (c == '\n') return refuse(f, 400, "a line ends with LF alone");
    if (c != '\r') {
        if (f->value_length == sizeof "HTTP/1.1" - 1)
            return refuse(f, 400, "the URI has a space, or the version of HTTP is malformed");
        f->value[f->value_length++] = c;
        return true;
    }
    const char *version = f->value;
    f->is_old = equals(version, f->value_length, "HTTP/1.0");
    f->state = FRAMING_LINE_LF;
    if (f->is_old || equals(version, f->value_length, "HTTP/1.1")) return true;
    const bool is_version = f->value_length == sizeof "HTTP/1.1" - 1 && memcmp(version, "HTTP/", 5) == 0;
    return is_version ? refuse(f, 505, "only the versions 1.1 and 1.0 of HTTP are served")
                      : refuse(f, 400, "the URI has a space, or the version of HTTP is malformed");
}

/* ---- headers and trailers ---- */

static bool count_header_byte(struct framing *f)
{
    if (++f->header_bytes <= FRAMING_HEADERS_MAX) return true;
    return refuse(f, 431,
                  f->is_trailer ? "the trailer is larger than 32768 bytes" : "the header is larger than 32768 bytes");
}

static bool take_field(struct framing *f, char c)
{
    if (c == '\r') {
        f->state = FRAMING_HEADER_LF;
        return true;
    }
    if (c == '\n') return refuse(f, 400, "a line ends with LF alone");
    if (c == ' ' || c == '\t') return refuse(f, 400, "a header line is folded, or begins with a space");
    if (++f->fields > FRAMING_FIELDS_MAX) return refuse(f, 431, "there are more than 100 headers");
    if (!is_token((unsigned char)c)) return refuse(f, 400, "a header's name is not a token");
    f->state = FRAMING_NAME;
    f->name_length = f->value_length = 0;
    f->line_bytes = 1;
    append(f->name, &f->name_length, c);
    return true;
}

/* Headers whose values pass, since http_exchange.c or libmicrohttpd reads them. With a `twice`, a header decides by its
 * one value: two of them are refused, since two readers of the request could each take another one. Those without are
 * lists, whose values count together, or names for the log. */
enum { HOST, LENGTH, ENCODING, EXPECT, FORWARDED_FOR, FORWARDED, KNOWN_FIRST };
static const struct {
    const char *name, *twice;
} KNOWN[] = {
    [HOST] = {"host", "exactly one Host header is needed"},
    [LENGTH] = {"content-length", "more than one Content-Length"},
    [ENCODING] = {"transfer-encoding", "more than one Transfer-Encoding"},
    [EXPECT] = {"expect", "more than one Expect"},
    [FORWARDED_FOR] = {"x-forwarded-for", NULL},
    [FORWARDED] = {"forwarded", NULL},
    [KNOWN_FIRST] = {"content-type", "more than one Content-Type"},
    {"content-encoding", "more than one Content-Encoding"},
    {"authorization", "more than one Authorization"},
    {"if-none-match", "more than one If-None-Match"},
    {"origin", "more than one Origin"},
    {"sec-fetch-site", "more than one Sec-Fetch-Site"},
    {"mcp-protocol-version", "more than one MCP-Protocol-Version"},
    {"mcp-method", "more than one Mcp-Method"},
    {"mcp-name", "more than one Mcp-Name"},
    {"accept", NULL},
    {"accept-encoding", NULL},
    {"connection", NULL},
    {"x-request-id", NULL},
    {"traceparent", NULL},
};
enum { KNOWN_COUNT = sizeof KNOWN / sizeof KNOWN[0] };
_Static_assert(KNOWN_COUNT <= 32, "framing.seen has a bit for each");

static uint32_t find_known(const struct framing *f)
{
    uint32_t i = 0;
    while (i < KNOWN_COUNT && !equals(f->name, f->name_length, KNOWN[i].name))
        i++;
    return i;
}

static bool is_read_here(const struct framing *f)
{
    return f->known < KNOWN_COUNT && (f->reads_client || (f->known != FORWARDED_FOR && f->known != FORWARDED));
}

/* Returns true for headers whose valid values have no space. Space around a value is no part of it (RFC 9112, 5). But
 * libmicrohttpd keeps trailing space, and after "chunked " it would read a body to the end of the connection. So no
 * space passes in these values. */
static bool is_compared_whole(const struct framing *f)
{
    return f->known == LENGTH || f->known == ENCODING || f->known == EXPECT;
}

static bool take_name(struct framing *f, char c)
{
    if (c == ':') {
        f->known = find_known(f);
        f->is_read = is_read_here(f);
        f->is_exact = is_compared_whole(f);
        return enter(f, FRAMING_VALUE);
    }
    if (c == '\r' || c == '\n') return refuse(f, 400, "a header line has no colon");
    if (!is_token((unsigned char)c)) return refuse(f, 400, "a header's name is not a token");
    if (++f->line_bytes > FRAMING_NAME_MAX) return refuse(f, 431, "a header's name is longer than 64 bytes");
    append(f->name, &f->name_length, c);
    return true;
}

/* Takes a byte of a header's value. Values are compared without the space around them. line_bytes counts the value's
 * bytes so far. */
static bool take_value(struct framing *f, char c)
{
    if (c == '\r') {
        f->state = FRAMING_VALUE_LF;
        return true;
    }
    if (is_control((unsigned char)c) && c != '\t')
        return refuse(f, 400, c == '\n' ? "a line ends with LF alone" : "a header's value has control characters");
    if (f->is_read && ++f->values_bytes > FRAMING_VALUES_MAX)
        return refuse(f, 431, "the values of the headers that the daemon uses are larger than 4096 bytes");
    const bool is_space = c == ' ' || c == '\t';
    f->is_dropped |= !f->is_read || (f->is_exact && is_space && f->line_bytes > 0);
    if (is_space && f->line_bytes == 0) return true;
    f->line_bytes++;
    if (is_space) return true;
    while (f->value_length < f->line_bytes - 1 && f->value_length < FRAMING_WORD_SIZE)
        f->value[f->value_length++] = ' '; /* inner space: no known value has any */
    append(f->value, &f->value_length, c);
    return true;
}

static bool parse_length(struct framing *f)
{
    uint64_t value = 0;
    for (uint32_t i = 0; i < f->value_length; i++) {
        const char c = f->value[i];
        if (c < '0' || c > '9' || __builtin_mul_overflow(value, 10u, &value) ||
            __builtin_add_overflow(value, (uint64_t)(c - '0'), &value))
            return false;
    }
    f->left = value;
    return f->value_length > 0 && f->value_length < FRAMING_WORD_SIZE;
}

static void note_fault(struct framing *f, int status, const char *detail)
{
    if (!f->wrong) f->wrong_status = status;
    if (!f->wrong) f->wrong = detail;
}

static bool has(const struct framing *f, uint32_t known)
{
    return (f->seen >> known & 1) != 0;
}

static void take_header(struct framing *f)
{
    if (f->is_trailer || f->known == KNOWN_COUNT) return; /* trailers do not affect framing */
    if (has(f, f->known) && KNOWN[f->known].twice) note_fault(f, 400, KNOWN[f->known].twice);
    f->seen |= (uint32_t)1 << f->known;
    if (f->known == LENGTH && !parse_length(f)) note_fault(f, 400, "Content-Length is not a number");
    if (f->known == ENCODING) f->is_chunked = equals(f->value, f->value_length, "chunked");
    if (f->known == EXPECT && !equals(f->value, f->value_length, "100-continue"))
        note_fault(f, 417, "the only expectation that is known is 100-continue");
}

/* HTTP/1.0 has no Host; the health checks of some load balancers send none. */
static bool check_header(struct framing *f)
{
    if (!has(f, HOST) && !f->is_old) return refuse(f, 400, KNOWN[HOST].twice);
    if (has(f, LENGTH) && has(f, ENCODING)) return refuse(f, 400, "both Content-Length and Transfer-Encoding");
    if (f->wrong) return refuse(f, f->wrong_status, f->wrong);
    if (has(f, ENCODING) && f->is_old) return refuse(f, 400, "Transfer-Encoding in HTTP/1.0");
    if (has(f, ENCODING) && !f->is_chunked)
        return refuse(f, 501, "the only Transfer-Encoding that is known is chunked");
    return true;
}

static bool end_header(struct framing *f)
{
    if (f->is_trailer) {
        f->state = FRAMING_START;
        return true;
    }
    if (!check_header(f)) return false;
    f->passed++;
    const bool has_body = f->left > 0;
    if (f->is_chunked) f->left = 0;
    return enter(f, f->is_chunked ? FRAMING_CHUNK_SIZE : has_body ? FRAMING_BODY : FRAMING_START);
}

/* ---- chunks ---- */

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    const char l = lower(c);
    return l >= 'a' && l <= 'f' ? l - 'a' + 10 : -1;
}

static bool take_chunk_size(struct framing *f, char c)
{
    const int digit = hex_digit(c);
    if (digit >= 0) {
        if (++f->line_bytes > CHUNK_DIGITS_MAX) return refuse(f, 400, "a chunk's size has too many digits");
        f->left = f->left << 4 | (uint64_t)digit;
        return true;
    }
    if (f->line_bytes == 0 || (c != '\r' && c != ';'))
        return refuse(f, 400, "a chunk's size is not a hexadecimal number");
    return enter(f, c == ';' ? FRAMING_CHUNK_EXTENSION : FRAMING_CHUNK_LF);
}

static bool take_chunk_extension(struct framing *f, char c)
{
    if (c == '\r') return enter(f, FRAMING_CHUNK_LF);
    if (is_control((unsigned char)c) && c != '\t')
        return refuse(f, 400, c == '\n' ? "a line ends with LF alone" : "a chunk's extension has control characters");
    if (++f->line_bytes > FRAMING_EXTENSION_MAX) return refuse(f, 400, "a chunk's extension is longer than 1024 bytes");
    return true;
}

static void end_chunk_line(struct framing *f)
{
    f->state = f->left > 0 ? FRAMING_CHUNK_DATA : FRAMING_FIELD;
    f->is_trailer = f->left == 0;
    if (f->is_trailer) f->header_bytes = f->fields = 0;
}

/* ---- the scanner ---- */

/* Takes the byte `wanted` and enters the next state. False: refused. */
static bool expect(struct framing *f, char c, char wanted, enum framing_state next)
{
    if (c != wanted)
        return refuse(f, 400, wanted == '\n' ? "a line has a CR without LF" : "a chunk is longer than its size says");
    f->state = next;
    return true;
}

/* Scans one byte outside a body. False: refused. Only the empty line at the end of a trailer passes: trailer lines are
 * never read, and might not fit. */
static bool take(struct framing *f, char c)
{
    f->is_dropped = f->is_trailer && f->state >= FRAMING_FIELD && f->state <= FRAMING_VALUE_LF &&
                    !(f->state == FRAMING_FIELD && c == '\r');
    switch (f->state) {
    case FRAMING_START:
        return start_request(f, c);
    case FRAMING_EMPTY_LF:
        return expect(f, c, '\n', FRAMING_START);
    case FRAMING_METHOD:
        return take_method(f, c);
    case FRAMING_TARGET:
        return take_target(f, c);
    case FRAMING_VERSION:
        return take_version(f, c);
    case FRAMING_LINE_LF:
        f->value_length = 0;
        return expect(f, c, '\n', FRAMING_FIELD);
    case FRAMING_FIELD:
        return count_header_byte(f) && take_field(f, c);
    case FRAMING_NAME:
        return count_header_byte(f) && take_name(f, c);
    case FRAMING_VALUE:
        return count_header_byte(f) && take_value(f, c);
    case FRAMING_VALUE_LF:
        if (!count_header_byte(f) || !expect(f, c, '\n', FRAMING_FIELD)) return false;
        take_header(f);
        return true;
    case FRAMING_HEADER_LF:
        return expect(f, c, '\n', FRAMING_START) && end_header(f);
    case FRAMING_CHUNK_SIZE:
        return take_chunk_size(f, c);
    case FRAMING_CHUNK_EXTENSION:
        return take_chunk_extension(f, c);
    case FRAMING_CHUNK_LF:
        if (!expect(f, c, '\n', FRAMING_CHUNK_DATA)) return false;
        end_chunk_line(f);
        return true;
    case FRAMING_CHUNK_DATA_CR:
        return expect(f, c, '\r', FRAMING_CHUNK_DATA_LF);
    case FRAMING_CHUNK_DATA_LF:
        f->line_bytes = 0;
        return expect(f, c, '\n', FRAMING_CHUNK_SIZE);
    default:
        return false;
    }
}

/* Skips the bytes of a body or a chunk without reading them. */
static size_t skip_body(struct framing *f, size_t size)
{
    const size_t skipped = f->left < size ? (size_t)f->left : size;
    f->left -= skipped;
    if (f->left == 0) f->state = f->state == FRAMING_BODY ? FRAMING_START : FRAMING_CHUNK_DATA_CR;
    return skipped;
}

void framing_refuse(struct framing *f, int status, const char *detail)
{
    refuse(f, status, detail);
    f->state = FRAMING_REFUSED;
}

size_t framing_scan(struct framing *f, char *bytes, size_t size)
{
    size_t kept = 0, whole = 0; /* bytes that pass, and those up to the end of the last complete request */
    uint64_t passed = f->passed;
    if (f->state == FRAMING_REFUSED) return 0;
    for (size_t at = 0; at < size;) {
        if (f->state == FRAMING_BODY || f->state == FRAMING_CHUNK_DATA) {
            const size_t skipped = skip_body(f, size - at);
            if (kept < at) memmove(bytes + kept, bytes + at, skipped);
            kept += skipped;
            at += skipped;
        } else {
            const char c = bytes[at++];
            if (!take(f, c)) {
                f->refused_body = (f->state >= FRAMING_BODY || f->is_trailer) && f->passed == passed;
                f->passed = passed; /* a header that is held back with the refused bytes has not passed */
                f->state = FRAMING_REFUSED;
                return whole;
            }
            if (!f->is_dropped) bytes[kept++] = c;
        }
        if (f->state == FRAMING_START) {
            whole = kept;
            passed = f->passed;
        }
    }
    return kept;
}
