#include "input/query/channel_list.h"

#include <stdio.h>
#include <string.h>

#include "input/scene/outputs.h"
#include "render_request.h"

static const char prefix[] = "/outputs/";

struct zr_output_pointer zr_output_pointer(const char *pointer, size_t number)
{
    struct zr_output_pointer out;
    const size_t begin = sizeof prefix - 1;
    if (strncmp(pointer, prefix, begin) == 0)
        snprintf(out.text, sizeof out.text, "%s%zu%s", prefix, number,
                 pointer + begin + strspn(pointer + begin, "0123456789"));
    else
        snprintf(out.text, sizeof out.text, "%s", pointer);
    return out;
}

size_t zr_channel_list_count(const struct zr_request *request)
{
    size_t count = 1;
    for (const char *at = request->channel; at && (at = strchr(at, ',')) != NULL; at++)
        count++;
    return count;
}

/* Returns the channel `number` of the list; *length: of its name. */
static const char *channel_at(const struct zr_request *request, size_t number, size_t *length)
{
    const char *at = request->channel;
    for (; number > 0; number--)
        at += strcspn(at, ",") + 1;
    *length = strcspn(at, ",");
    return at;
}

/* True if the parameter belongs to channel `number` of the list. */
static bool belongs(const struct zr_request *request, size_t number, const char *parameter)
{
    char name[32];
    size_t length;
    const char *at = channel_at(request, number, &length);
    snprintf(name, sizeof name, "%.*s", length < sizeof name ? (int)length : 0, at);
    const int channel = zr_names_find(&zr_channel_names, name);
    if (channel < 0 || channel >= ZR_CHANNEL_COUNT) return false;
    if (strcmp(parameter, "x") == 0 || strcmp(parameter, "y") == 0) return channel == ZR_CHANNEL_FRAGMENTS;
    const int given = request->encoding ? zr_names_find(&zr_encoding_names, request->encoding) : -1;
    const bool has_it =
        given >= 0 && given < ZR_ENCODING_COUNT && zr_channel_has((enum zr_channel)channel, (enum zr_encoding)given);
    const enum zr_encoding encoding = has_it ? (enum zr_encoding)given : zr_channel_rows[channel].encodings[0];
    if (strcmp(parameter, "scale") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_SCALE);
    if (strcmp(parameter, "lossless") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_LOSSLESS);
    if (strcmp(parameter, "quality") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_QUALITY);
    if (strcmp(parameter, "maxBytes") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_MAX_BYTES);
    return has_it;
}

static const char *copy(struct zr_arena *arena, const char *text, size_t length)
{
    char *copied = zr_arena_alloc(arena, length + 1, 1);
    if (!copied) return NULL;
    memcpy(copied, text, length);
    copied[length] = '\0';
    return copied;
}

const char *zr_channel_list_text(const struct zr_request *request, struct zr_arena *arena, size_t number,
                                 const char *parameter, const char *text)
{
    const size_t count = text ? zr_channel_list_count(request) : 1;
    if (count == 1) return text;
    if (strcmp(parameter, "channel") == 0) {
        size_t length;
        const char *at = channel_at(request, number, &length);
        return copy(arena, at, length);
    }
    if (belongs(request, number, parameter)) return text;
    for (size_t other = 0; other < count; other++)
        if (number > 0 || belongs(request, other, parameter)) return NULL;
    return text;
}
