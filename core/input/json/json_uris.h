/* json_uris.h - input: the long data: URIs of a text, each passed and decoded once.
 *
 * A file of glTF is passed several times, and its data: URIs may be nearly all of it. Their places are noted when they
 * are first passed. URIs that the caller keeps are compared with its copies, and neither parsed nor decoded.
 */
#ifndef ZR_JSON_URIS_H
#define ZR_JSON_URIS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/hash.h"
#include "core.h"
#include "input/text/text.h"

/* The size of the smallest URI that is noted, and the most that are noted. */
enum { ZR_JSON_URI_MIN = 16 << 10, ZR_JSON_URIS_MAX = 1024 };

/* A string without escapes that begins with "data:". */
struct zr_json_uri {
    const char *text;
    size_t size;
    struct zr_file_hash hash; /* for zr_kept_texts.keep */
    const void *bytes;        /* decoded; NULL: not kept */
    size_t byte_count;
};

struct zr_json_uris {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    struct zr_kept_texts kept;
    size_t count, room;
    struct zr_json_uri *items; /* in the order of the text */
};

/* Returns the URI whose text begins at `text`, the byte after the opening quote. NULL: it is not noted. */
const struct zr_json_uri *zr_json_uri_at(const struct zr_json_uris *uris, const char *text);

/* Looks among the kept texts for the string that begins at `text`, of a document up to `end`. Sets its size and its
 * hash, or size 0 if it is short. True if it is kept; it is then noted. */
bool zr_json_uri_find(struct zr_json_uris *uris, const char *text, const char *end, struct zr_json_uri *uri);

/* Notes a URI after all others. Drops it if there is no room. */
void zr_json_uri_note(struct zr_json_uris *uris, const struct zr_json_uri *uri);

/* Decodes a noted URI, or another one of `size` bytes at `text`, into the arena. Takes the bytes that the caller keeps,
 * and charges the arena for as much as decoding. ZR_OK, ZR_NO_MEMORY, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_json_uri_decode(struct zr_json_uris *uris, const char *text, size_t size, const void **bytes,
                                  size_t *byte_count, struct zr_reason *reason);

#endif
