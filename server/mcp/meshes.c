#include "meshes.h"

enum { IN_MESH = 2 };

bool mcp_meshes_next(struct zr_json *json, struct mcp_span *name)
{
    struct zr_json_text key;
    if (json->depth == 0 && zr_json_type(json) == ZR_JSON_LIST) zr_json_enter(json, '[');
    while (json->depth > 0 && !zr_json_stops(json)) {
        if (json->depth == IN_MESH) {
            if (!zr_json_member(json, &key)) continue;
            *name = mcp_span_skip(json);
            if (zr_json_is(&key, "asset") && mcp_span_is(*name, "\"model\"")) return true;
        } else if (zr_json_item(json)) {
            if (zr_json_type(json) == ZR_JSON_OBJECT)
                zr_json_enter(json, '{');
            else
                zr_json_skip(json);
        }
    }
    return false;
}
