/* Bytes that a scene brings along: in a data: URI, or beside it under a name; and those kept under their hash. */
#include <string.h>

#include "input/data_uri.h"
#include "input/json_scene.h"

enum { URI, ASSET, KEYS };
static const char *const words[] = {"uri", "asset"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

static bool read_uri(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                     struct zr_given_bytes *out)
{
    struct zr_reason reason;
    const char *text;
    if (!zr_json_string(&draft->json, path, node, &text)) return false;
    enum zr_status status = zr_data_uri_read(draft->json.arena, text, &out->bytes, &out->size, &reason);
    if (status == ZR_BAD_SCENE) zr_json_fault(&draft->json, path, "%s", reason.text);
    return status == ZR_OK;
}

static bool read_stored(struct zr_draft *draft, const struct zr_json_path *path, const char *sha256,
                        struct zr_given_bytes *out)
{
    enum { DIGITS = 64 };
    struct zr_json *json = &draft->json;
    if (strspn(sha256, "0123456789abcdef") != DIGITS || sha256[DIGITS] != '\0')
        return zr_json_fault(json, path, "expected sha256: and 64 lower-case hexadecimal digits");
    if (!draft->stored.read)
        return zr_json_fault(json, path,
                             "no assets are kept here, that takes zrasterd --assets-dir; send the bytes as a "
                             "part of a multipart/form-data request");
    switch (draft->stored.read(draft->stored.context, sha256, json->arena, &out->bytes, &out->size)) {
    case ZR_OK:
        return true;
    case ZR_BAD_SCENE:
        return zr_json_fault(json, path, "no asset is kept under this hash; upload it with PUT /v1/assets/%s", sha256);
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

static bool read_asset(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                       struct zr_given_bytes *out)
{
    static const char STORED[] = "sha256:";
    const char *name;
    if (!zr_json_string(&draft->json, path, node, &name)) return false;
    if (strncmp(name, STORED, sizeof STORED - 1) == 0) return read_stored(draft, path, name + sizeof STORED - 1, out);
    for (size_t i = 0; i < draft->asset_count; i++)
        if (strcmp(draft->assets[i].name, name) == 0) {
            draft->assets_used[i] = true;
            *out = (struct zr_given_bytes){draft->assets[i].bytes, draft->assets[i].size};
            return true;
        }
    return zr_json_fault(&draft->json, path, "no part of a multipart/form-data request has the name %s",
                         zr_quote(name, strlen(name)).text);
}

bool zr_draft_read_bytes(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                         struct zr_given_bytes *out)
{
    const cJSON *found[KEYS];
    if (cJSON_IsString(node)) return read_uri(draft, path, node, out);
    if (!cJSON_IsObject(node))
        return zr_json_fault(&draft->json, path, "expected a data: URI, {\"uri\": ...} or {\"asset\": ...}");
    zr_json_object(&draft->json, path, node, &keys, found);
    if (!found[URI] == !found[ASSET])
        return zr_json_fault(&draft->json, path, "%s of uri and asset is needed", found[URI] ? "only one" : "one");
    if (found[URI]) return read_uri(draft, ZR_JSON_KEY(path, words[URI]), found[URI], out);
    return read_asset(draft, ZR_JSON_KEY(path, words[ASSET]), found[ASSET], out);
}
