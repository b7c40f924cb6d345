#include "input/json/json_uris.h"

#include <string.h>

#include "base/cancel.h"
#include "input/text/base64.h"

enum { SEARCHED_AT_ONCE = 1 << 20, ROOM = 8 };

const struct zr_json_uri *zr_json_uri_at(const struct zr_json_uris *uris, const char *text)
{
    size_t low = 0, high = uris->count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (uris->items[middle].text < text)
            low = middle + 1;
        else
            high = middle;
    }
    return low < uris->count && uris->items[low].text == text ? &uris->items[low] : NULL;
}

void zr_json_uri_note(struct zr_json_uris *uris, const struct zr_json_uri *uri)
{
    if (uris->count == ZR_JSON_URIS_MAX) return;
    if (uris->count > 0 && uris->items[uris->count - 1].text >= uri->text) return;
    if (uris->count == uris->room) {
        struct zr_json_uri *more =
            zr_arena_grow(uris->arena, uris->items, uris->count, uris->room ? 2 * uris->room : ROOM, sizeof *more);
        if (!more) return;
        uris->items = more;
        uris->room = uris->room ? 2 * uris->room : ROOM;
    }
    uris->items[uris->count++] = *uri;
}

/* Returns the first quote from `at` on, or NULL. */
static const char *find_quote(const struct zr_json_uris *uris, const char *at, const char *end)
{
    const char *quote = NULL;
    while (!quote && at < end && !zr_is_cancelled(uris->cancel)) {
        const size_t count = end - at < SEARCHED_AT_ONCE ? (size_t)(end - at) : SEARCHED_AT_ONCE;
        quote = memchr(at, '"', count);
        at += count;
    }
    return quote;
}

bool zr_json_uri_find(struct zr_json_uris *uris, const char *text, const char *end, struct zr_json_uri *uri)
{
    const struct zr_kept_texts *kept = &uris->kept;
    const char *quote = find_quote(uris, text, end);
    *uri = (struct zr_json_uri){.text = text};
    if (!quote || quote - text < ZR_JSON_URI_MIN) return false;
    uri->size = (size_t)(quote - text);
    if (!kept->find ||
        !kept->find(kept->context, text, uri->size, uris->cancel, &uri->hash, &uri->bytes, &uri->byte_count))
        return false;
    zr_json_uri_note(uris, uri);
    return true;
}

enum zr_status zr_json_uri_decode(struct zr_json_uris *uris, const char *text, size_t size, const void **bytes,
                                  size_t *byte_count, struct zr_reason *reason)
{
    const struct zr_json_uri *uri = zr_json_uri_at(uris, text);
    const struct zr_kept_texts *kept = &uris->kept;
    if (uri && uri->bytes) {
        *bytes = uri->bytes;
        *byte_count = uri->byte_count;
        return zr_arena_alloc(uris->arena, zr_base64_room(size), 1) ? ZR_OK : ZR_NO_MEMORY;
    }
    const enum zr_status status = zr_data_uri_read(uris->arena, text, size, bytes, byte_count, reason);
    if (status == ZR_OK && uri && kept->keep) kept->keep(kept->context, &uri->hash, text, size, *bytes, *byte_count);
    return status;
}
