/* How faces look: said by a scene, a material, a mesh or a polygon, with the same keys. */
#include "input/defaults.h"
#include "input/json_scene.h"

enum { OUTLINE_IN_COLOR = 2 };

static const char *const words[] = {ZR_LOOK_WORDS};

const struct zr_look zr_look_unsaid = {ZR_UNSAID, ZR_UNSAID, ZR_UNSAID, ZR_UNSAID, {0, 0, 0, 1}};

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
        look->outline = OUTLINE_IN_COLOR;
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

static int said(int first, int second)
{
    return first != ZR_UNSAID ? first : second;
}

struct zr_look zr_look_over(const struct zr_look *first, const struct zr_look *second)
{
    const struct zr_look *outlined = first->outline != ZR_UNSAID ? first : second;
    return (struct zr_look){.shading = said(first->shading, second->shading),
                            .double_sided = said(first->double_sided, second->double_sided),
                            .fill = said(first->fill, second->fill),
                            .outline = outlined->outline,
                            .outline_color = outlined->outline_color};
}

/* Outlines on faces would not be seen in the faces' own colours: they are black unless told otherwise. */
struct zr_material zr_look_material(const struct zr_look *look, zr_vec4 base_color, bool smooth)
{
    struct zr_material material = {.base_color = base_color,
                                   .shading = look->shading == ZR_UNSAID ? zr_default_shading(smooth)
                                                                         : (enum zr_shading)look->shading,
                                   .double_sided = look->double_sided == 1,
                                   .hollow = look->fill == 0,
                                   .outline_color = {0, 0, 0, 1}};
    if (look->outline == OUTLINE_IN_COLOR) material.outline_color = look->outline_color;
    if (look->outline == 1) material.outline = material.hollow ? ZR_OUTLINE_OWN : ZR_OUTLINE_COLORED;
    if (look->outline == OUTLINE_IN_COLOR) material.outline = ZR_OUTLINE_COLORED;
    return material;
}
