/* How faces look: said by a scene, a material, a mesh or a polygon, with the same keys. */
#include "input/json_scene.h"

static const char *const words[] = {ZR_LOOK_WORDS};

static void read_flag(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, int *out)
{
    bool value;
    if (node && zr_json_bool(json, path, node, &value)) *out = value;
}

/* true, false, or a colour. */
static void read_outline(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                         struct zr_look *look)
{
    struct zr_json *json = &draft->json;
    if (cJSON_IsBool(node))
        read_flag(json, path, node, &look->outline);
    else if (!cJSON_IsString(node) && !cJSON_IsArray(node))
        zr_json_fault(json, path, "true, false or a colour is needed");
    else if (zr_json_color(json, path, node, &look->outline_color)) {
        look->outline = ZR_OUTLINE_SAID_IN_COLOR;
        zr_draft_note_alpha(draft, &look->outline_color, 1);
    }
}

void zr_draft_read_look(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *const *nodes, int count,
                        struct zr_look *look)
{
    struct zr_json *json = &draft->json;
    *look = zr_look_unsaid;
    for (int key = 0; key < count; key++) {
        const struct zr_json_path *at = ZR_JSON_KEY(path, words[key]);
        if (!nodes[key]) continue;
        if (key == ZR_LOOK_SHADING) zr_json_choice(json, at, nodes[key], &zr_shading_names, &look->shading);
        if (key == ZR_LOOK_FILL) read_flag(json, at, nodes[key], &look->fill);
        if (key == ZR_LOOK_OUTLINE) read_outline(draft, at, nodes[key], look);
        if (key == ZR_LOOK_DOUBLE_SIDED) read_flag(json, at, nodes[key], &look->double_sided);
    }
}
