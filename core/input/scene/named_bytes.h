/* named_bytes.h - input: bytes that a key of a scene names: a data: URI, a part of the request, or a stored asset
 * (json_bytes.c). */
#ifndef ZR_NAMED_BYTES_H
#define ZR_NAMED_BYTES_H

#include "core.h"
#include "input/json/json_value.h"

/* A name of bytes: one of two keys. */
struct zr_bytes_name {
    const char *uri, *asset; /* NULL: not given */
};

/* Rows for the table of an object that fills a `type`, whose member `name` is a struct zr_bytes_name. */
#define ZR_BYTES_URI   "uri"
#define ZR_BYTES_ASSET "asset"
#define ZR_BYTES_NAME_FIELDS(type, name)                                                                               \
    {.key = ZR_BYTES_URI,                                                                                              \
     .read = zr_json_string,                                                                                           \
     .offset = offsetof(type, name.uri),                                                                               \
     .text = "data: URI with the bytes",                                                                               \
     .schema = ZR_SCHEMA_OF("dataUri")},                                                                               \
    {                                                                                                                  \
        .key = ZR_BYTES_ASSET, .read = zr_json_string, .offset = offsetof(type, name.asset),                           \
        .text = "name of a file beside the scene (HTTP: of a part), or sha256: and the hash of an asset"               \
    }

/* The bytes of a data: URI, {"uri": one}, {"asset": name} or {"asset": "sha256:..."}. They stay in the
 * arena or in the request. */
struct zr_parsed_bytes {
    const void *bytes;
    size_t size;
};
bool zr_parsed_read_named(struct zr_json *json, const struct zr_json_path *path, const struct zr_bytes_name *name,
                          struct zr_parsed_bytes *out);
/* Returns the 64 digits of the name of a stored asset, "sha256:..."; NULL: another name. */
const char *zr_stored_name(const char *asset);

bool zr_parsed_read_bytes(struct zr_json *json, const struct zr_json_path *path, struct zr_parsed_bytes *out);

/* The same for an object that may also name an array of numbers. */
bool zr_parsed_read_asset(struct zr_json *json, const struct zr_json_path *path, struct zr_asset *out);

#endif
