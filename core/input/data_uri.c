#include "input/data_uri.h"

#include <string.h>
#include <strings.h>

#include "input/base64.h"

/* Limits the search for a comma: media types are shorter. */
enum { HEAD_MAX = 256 };

static const char SCHEME[] = "data:", BASE64[] = ";base64";

static bool ends_with(const char *text, size_t size, const char *end, size_t end_size)
{
    return size >= end_size && strncasecmp(text + size - end_size, end, end_size) == 0;
}

/* Returns the start of the base64 text; NULL with the reason. */
static const char *find_payload(const char *text, struct zr_reason *reason)
{
    if (strncasecmp(text, SCHEME, sizeof SCHEME - 1) != 0) {
        zr_reason_give(reason, "%s is not a data: URI; nothing is fetched from elsewhere",
                       zr_quote(text, strnlen(text, HEAD_MAX)).text);
        return NULL;
    }
    const char *head = text + sizeof SCHEME - 1;
    size_t length = strnlen(head, HEAD_MAX);
    const char *comma = memchr(head, ',', length);
    if (!comma || !ends_with(head, (size_t)(comma - head), BASE64, sizeof BASE64 - 1)) {
        zr_reason_give(reason, "a data: URI without ;base64, in front of its bytes");
        return NULL;
    }
    return comma + 1;
}

enum zr_status zr_data_uri_read(struct zr_arena *arena, const char *text, const void **bytes, size_t *size,
                                struct zr_reason *reason)
{
    const char *payload = find_payload(text, reason);
    if (!payload) return ZR_BAD_SCENE;
    size_t length = strlen(payload);
    unsigned char *out = zr_arena_alloc(arena, zr_base64_room(length), 1);
    if (!out) return ZR_NO_MEMORY;
    *bytes = out;
    if (zr_base64_decode(payload, length, out, size)) return ZR_OK;
    if (*size < length)
        zr_reason_give(reason, "not base64 at character %zu: %s", *size, zr_quote(payload + *size, 1).text);
    else
        zr_reason_give(reason, "base64 that is cut short: %zu characters are no multiple of 4", length);
    return ZR_BAD_SCENE;
}
