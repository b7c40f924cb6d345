/* Bytes of a scene: in a data: URI, in a named part of the request, or stored under their hash. */
#include <string.h>

#include "input/files/file_parts.h"
#include "input/json/json_bytes.h"
#include "input/text/base64.h"
#include "render_request.h"

struct given {
    struct zr_bytes_name name;
};
static const struct zr_json_field fields[] = {ZR_BYTES_NAME_FIELDS(struct given, name)};
static const struct zr_json_rule rules[] = {ZR_BYTES_NAME_RULES(0)};
const struct zr_json_object zr_json_object_bytes = {ZR_JSON_FIELDS("bytes", fields), ZR_JSON_RULES(rules)};

bool zr_json_check_read(struct zr_json *json, const struct zr_json_path *path, enum zr_status status,
                        const struct zr_reason *reason)
{
    if (status == ZR_BAD_SCENE) zr_json_fault(json, path, "%s", reason->text);
    if (status == ZR_CANCELLED) zr_error_add(json->error, ZR_CANCELLED, NULL, "reading was stopped");
    return status == ZR_OK;
}

static bool read_uri(struct zr_json *json, const struct zr_json_path *path, const char *text, struct zr_asset *out)
{
    struct zr_reason reason;
    enum zr_status status = zr_data_uri_read(json->arena, text, strlen(text), &out->bytes, &out->size, &reason);
    if (status == ZR_BAD_SCENE) zr_json_fault(json, path, "%s", reason.text);
    return status == ZR_OK;
}

static bool read_stored(struct zr_json *json, const struct zr_json_path *path, const char *asset, struct zr_asset *out)
{
    const struct zr_stored *stored = &json->assets->stored;
    const char *sha256 = zr_stored_name(asset);
    if (!sha256) return zr_json_fault(json, path, "expected sha256: and 64 lower-case hexadecimal digits");
    const char *advice = stored->advice ? stored->advice : "hand the bytes over as a part of the request";
    if (!stored->read) return zr_json_fault(json, path, "no assets are kept here; %s", advice);
    switch (stored->read(stored->context, sha256, json->arena, &out->bytes, &out->size)) {
    case ZR_OK:
        return true;
    case ZR_BAD_SCENE:
        return zr_json_fault(json, path, "no asset is kept under the hash %s; %s", sha256, advice);
    case ZR_CANCELLED:
        zr_error_add(json->error, ZR_CANCELLED, NULL, "reading was stopped");
        return false;
    case ZR_NO_MEMORY:
        return false;
    default:
        zr_error_add(json->error, ZR_INTERNAL, NULL, "the asset %s could not be read", sha256);
        return false;
    }
}

static bool read_asset(struct zr_json *json, const struct zr_json_path *path, const char *name, struct zr_asset *out)
{
    if (strncmp(name, ZR_STORED, sizeof ZR_STORED - 1) == 0) return read_stored(json, path, name, out);
    struct zr_parsed_assets *assets = json->assets;
    const struct zr_asset *asset = zr_file_part_named(assets, json->arena, name, assets->use);
    if (asset) *out = *asset;
    if (asset || !zr_arena_ok(json->arena)) return asset != NULL;
    return zr_json_fault(json, path, "no part of the request has the name %s", zr_quote(name, strlen(name)).text);
}

/* Finds a file or an array. */
static bool find_named(struct zr_json *json, const struct zr_json_path *path, const struct zr_bytes_name *name,
                       struct zr_asset *out)
{
    *out = (struct zr_asset){.name = ""};
    return name->uri ? read_uri(json, ZR_JSON_KEY(path, ZR_BYTES_URI), name->uri, out)
                     : read_asset(json, ZR_JSON_KEY(path, ZR_BYTES_ASSET), name->asset, out);
}

bool zr_parsed_read_asset(struct zr_json *json, const struct zr_json_path *path, struct zr_asset *out)
{
    struct given given = {{NULL, NULL}};
    uint64_t keys;
    const size_t faults = json->error->count;
    return zr_json_fields(json, path, &zr_json_object_bytes, &given, &keys) && !zr_json_failed_since(json, faults) &&
           zr_arena_ok(json->arena) && find_named(json, path, &given.name, out);
}

/* Refuses arrays of numbers. */
static bool take_file(struct zr_json *json, const struct zr_json_path *path, const struct zr_asset *asset,
                      struct zr_parsed_bytes *out)
{
    if (asset->array.type != ZR_BYTES)
        return zr_json_fault(json, ZR_JSON_KEY(path, ZR_BYTES_ASSET),
                             "the part %s is an array of %s; the bytes of a file are needed",
                             zr_quote(asset->name, strlen(asset->name)).text, zr_number_name(asset->array.type));
    *out = (struct zr_parsed_bytes){asset->bytes, asset->size};
    return true;
}

bool zr_parsed_read_named(struct zr_json *json, const struct zr_json_path *path, const struct zr_bytes_name *name,
                          struct zr_parsed_bytes *out)
{
    struct zr_asset asset;
    return find_named(json, path, name, &asset) && take_file(json, path, &asset, out);
}

bool zr_parsed_read_bytes(struct zr_json *json, const struct zr_json_path *path, struct zr_parsed_bytes *out)
{
    const enum zr_json_type type = zr_json_type(json);
    struct zr_asset asset = {.name = ""};
    const char *uri;
    if (type == ZR_JSON_STRING)
        return zr_json_string(json, path, &uri) && read_uri(json, path, uri, &asset) &&
               take_file(json, path, &asset, out);
    if (type != ZR_JSON_OBJECT)
        return zr_json_skip(json) &&
               zr_json_fault(json, path, "expected a data: URI, {\"uri\": ...} or {\"asset\": ...}");
    return zr_parsed_read_asset(json, path, &asset) && take_file(json, path, &asset, out);
}
