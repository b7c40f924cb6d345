#include "proxy_header.h"

#include <string.h>

enum { V2_BEGIN = 16, COMMAND = 12, FAMILY = 13, LENGTH = 14, SIGNATURE = 12, FIELDS = 6 };
enum { FAMILY_ANY, FAMILY_FOUR, FAMILY_SIX, FAMILY_UNIX, FAMILIES };

static const char WORD[] = "PROXY ";
static const char SIGN[SIGNATURE] = {'\r', '\n', '\r', '\n', 0, '\r', '\n', 'Q', 'U', 'I', 'T', '\n'};
static const uint32_t ADDRESSES_SIZE[FAMILIES] = {0, 12, 36, 216};

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

static bool is_like(const void *bytes, size_t size, const char *wanted, size_t wanted_size)
{
    return memcmp(bytes, wanted, smaller(size, wanted_size)) == 0;
}

bool proxy_header_begins(const char *bytes, size_t size)
{
    return (size >= sizeof WORD - 1 && is_like(bytes, size, WORD, sizeof WORD - 1)) ||
           (size >= SIGNATURE && is_like(bytes, size, SIGN, SIGNATURE));
}

/* ---- version 1: PROXY TCP4 192.0.2.1 192.0.2.2 56324 443 ---- */

struct field {
    const char *at;
    size_t length;
};

static bool is_field(const struct field *field, const char *word)
{
    return field->length == strlen(word) && memcmp(field->at, word, field->length) == 0;
}

static bool is_port(const struct field *field)
{
    unsigned port = 0;
    if (field->length == 0 || field->length > 5) return false;
    for (size_t i = 0; i < field->length; i++) {
        if (field->at[i] < '0' || field->at[i] > '9') return false;
        port = port * 10 + (unsigned)(field->at[i] - '0');
    }
    return port <= UINT16_MAX;
}

/* Splits a line at single spaces, into FIELDS at most. */
static size_t split(const char *line, size_t length, struct field fields[FIELDS])
{
    const char *const end = line + length;
    size_t count = 0;
    while (count < FIELDS) {
        const char *space = count + 1 < FIELDS ? memchr(line, ' ', (size_t)(end - line)) : NULL;
        fields[count++] = (struct field){line, (size_t)((space ? space : end) - line)};
        if (!space) break;
        line = space + 1;
    }
    return count;
}

static bool is_address(struct ip *ip, const struct field *field, bool is_six)
{
    return ip_parse(ip, field->at, field->length) && (memchr(field->at, ':', field->length) != NULL) == is_six;
}

static void end_line(struct proxy_header *header)
{
    struct field fields[FIELDS] = {{NULL, 0}};
    struct ip target;
    const char *line = (const char *)header->bytes;
    if (header->taken < 2 || line[header->taken - 2] != '\r') {
        header->wrong = "the PROXY header ends with LF alone";
        return;
    }
    const size_t count = split(line, header->taken - 2, fields);
    header->is_whole = true;
    if (count > 1 && is_field(&fields[1], "UNKNOWN")) return; /* what follows is ignored */
    const bool is_six = count > 1 && is_field(&fields[1], "TCP6");
    header->has_source = count == FIELDS && (is_six || is_field(&fields[1], "TCP4")) &&
                         is_address(&header->source, &fields[2], is_six) && is_address(&target, &fields[3], is_six) &&
                         is_port(&fields[4]) && is_port(&fields[5]);
    header->is_whole = header->has_source;
    if (!header->is_whole) header->wrong = "the PROXY header is malformed";
}

static void take_of_line(struct proxy_header *header, uint8_t byte)
{
    if (byte == '\n')
        end_line(header);
    else if (header->taken == PROXY_HEADER_V1_MAX)
        header->wrong = "the PROXY header is longer than 107 bytes";
}

/* ---- version 2: binary ---- */

static unsigned family_of(const struct proxy_header *header)
{
    return header->bytes[FAMILY] >> 4;
}

static bool is_local(const struct proxy_header *header)
{
    return header->bytes[COMMAND] == 0x20;
}

static void read_size(struct proxy_header *header)
{
    const uint32_t length = (uint32_t)header->bytes[LENGTH] << 8 | header->bytes[LENGTH + 1];
    const unsigned family = family_of(header), transport = header->bytes[FAMILY] & 0xF;
    header->size = V2_BEGIN + length;
    if (header->bytes[COMMAND] >> 4 != 2)
        header->wrong = "the PROXY header has a version other than 1 and 2";
    else if (header->bytes[COMMAND] > 0x21)
        header->wrong = "the PROXY header has an unknown command";
    else if (header->size > PROXY_HEADER_V2_MAX)
        header->wrong = "the PROXY header is longer than 4096 bytes";
    else if (!is_local(header) && (family >= FAMILIES || transport > 2))
        header->wrong = "the PROXY header has an unknown kind of address";
    else if (!is_local(header) && length < ADDRESSES_SIZE[family])
        header->wrong = "the PROXY header is shorter than its addresses";
}

static void end_binary(struct proxy_header *header)
{
    const uint8_t *source = header->bytes + V2_BEGIN;
    header->is_whole = true;
    if (is_local(header)) return;
    header->has_source = family_of(header) == FAMILY_FOUR || family_of(header) == FAMILY_SIX;
    if (family_of(header) == FAMILY_FOUR) header->source = ip_of_four(source);
    if (family_of(header) == FAMILY_SIX) memcpy(header->source.bytes, source, IP_SIZE);
}

/* ---- both ---- */

static void take(struct proxy_header *header, uint8_t byte)
{
    if (header->taken < sizeof header->bytes) header->bytes[header->taken] = byte;
    header->taken++;
    const size_t held = smaller(header->taken, sizeof header->bytes);
    if (is_like(header->bytes, held, WORD, sizeof WORD - 1)) {
        take_of_line(header, byte);
        return;
    }
    if (!is_like(header->bytes, held, SIGN, SIGNATURE)) header->wrong = "the connection begins without a PROXY header";
    if (header->taken == V2_BEGIN) read_size(header);
    if (!header->wrong && header->taken >= V2_BEGIN && header->taken == header->size) end_binary(header);
}

size_t proxy_header_take(struct proxy_header *header, const char *bytes, size_t size)
{
    size_t taken = 0;
    while (taken < size && !header->is_whole && !header->wrong)
        take(header, (uint8_t)bytes[taken++]);
    return taken;
}
