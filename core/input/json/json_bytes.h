/* json_bytes.h - input: bytes that a key of a scene names: a data: URI, a part of the request, or a stored asset
 * (json_bytes.c). */
#ifndef ZR_JSON_BYTES_H
#define ZR_JSON_BYTES_H

#include "input/files/assets.h"
#include "input/json/json_value.h"
#include "input/text/text.h"

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

/* The rules of these keys, whose numbers in the table are `first` and `first` + 1. */
#define ZR_BYTES_NAME_RULES(first)                                                                                     \
    {.kind = ZR_RULE_SOME, .text = "one of uri and asset is needed", .sets = {ZR_KEY(first) | ZR_KEY((first) + 1)}},   \
    {                                                                                                                  \
        .kind = ZR_RULE_APART, .text = "only one of uri and asset is needed", .sets = {                                \
            ZR_KEY(first),                                                                                             \
            ZR_KEY((first) + 1)                                                                                        \
        }                                                                                                              \
    }

/* Find the bytes of a data: URI, {"uri": one}, {"asset": name} or {"asset": "sha256:..."}. They stay in the arena or
 * in the request. */
bool zr_parsed_read_named(struct zr_json *json, const struct zr_json_path *path, const struct zr_bytes_name *name,
                          struct zr_parsed_bytes *out);
bool zr_parsed_read_bytes(struct zr_json *json, const struct zr_json_path *path, struct zr_parsed_bytes *out);

/* The same for an object that may also name an array of numbers. */
bool zr_parsed_read_asset(struct zr_json *json, const struct zr_json_path *path, struct zr_asset *out);

/* Reports a failed reading of bytes: at `path` with its reason, or as cancelled. Returns true if the status is OK. */
bool zr_json_check_read(struct zr_json *json, const struct zr_json_path *path, enum zr_status status,
                        const struct zr_reason *reason);

extern const struct zr_json_object zr_json_object_bytes;

#endif
