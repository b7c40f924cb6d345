#include <stdlib.h>
#include <string.h>

#include "input/defaults.h"
#include "input/json_scene.h"
#include "input/text.h"

enum { SHADINGS = ZR_SHADING_GOURAUD + 1, LOOKS = SHADINGS * 2, MATERIALS_AT_FIRST = 16 };

enum { NAME, BASE_COLOR, DOUBLE_SIDED, SHADING, KEYS };
static const char *const words[] = {"name",      "baseColorFactor", "doubleSided", "shading",  "baseColorTexture",
                                    "alphaMode", "alphaCutoff",     "diffuse",     "specular", "shininess",
                                    "emissive"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

static void read_shading(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, int *out)
{
    if (node) zr_json_choice(json, ZR_JSON_KEY(path, "shading"), node, &zr_shading_names, out);
}

static void read_double_sided(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, int *out)
{
    bool value;
    if (node && zr_json_bool(json, ZR_JSON_KEY(path, "doubleSided"), node, &value)) *out = value;
}

/* Equal names stay in the scene's order, so that the later one is the repetition. */
static int compare_given(const void *left, const void *right)
{
    const struct zr_given_material *a = left, *b = right;
    int order = strcmp(a->name, b->name);
    return order != 0 ? order : a->number < b->number ? -1 : a->number > b->number;
}

static int compare_name(const void *name, const void *given)
{
    return strcmp(name, ((const struct zr_given_material *)given)->name);
}

static void read_material(struct zr_builder *builder, const struct zr_json_path *path, const cJSON *node,
                          struct zr_given_material *given)
{
    struct zr_json *json = &builder->json;
    const cJSON *found[KEYS];
    if (!zr_json_object(json, path, node, &keys, found)) return;
    if (!found[NAME])
        zr_json_fault(json, path, "a material needs a name to be asked for by");
    else if (!zr_json_string(json, ZR_JSON_KEY(path, words[NAME]), found[NAME], &given->name))
        given->name = "";
    if (found[BASE_COLOR] &&
        zr_json_color(json, ZR_JSON_KEY(path, words[BASE_COLOR]), found[BASE_COLOR], &given->base_color))
        zr_builder_note_alpha(builder, &given->base_color, 1);
    read_double_sided(json, path, found[DOUBLE_SIDED], &given->double_sided);
    read_shading(json, path, found[SHADING], &given->shading);
}

static void refuse_repeated_names(struct zr_builder *builder, const struct zr_json_path *path)
{
    for (size_t i = 1; i < builder->given_count && !zr_json_full(&builder->json); i++) {
        const struct zr_given_material *before = &builder->given[i - 1], *given = &builder->given[i];
        if (strcmp(before->name, given->name) == 0)
            zr_json_fault(&builder->json, ZR_JSON_KEY(ZR_JSON_ITEM(path, given->number), words[NAME]),
                          "%s is the name of material %zu already", zr_quote(given->name, strlen(given->name)).text,
                          before->number);
    }
}

void zr_builder_read_materials(struct zr_builder *builder, const struct zr_json_path *path, const cJSON *list)
{
    struct zr_json *json = &builder->json;
    size_t count = 0, i = 0;
    if (list && !zr_json_array(json, path, list, &count)) list = NULL;
    builder->given = zr_arena_alloc(json->arena, count, sizeof *builder->given);
    /* Behind the given ones come two of our own: for what has colours, and for what has none. */
    builder->variants = zr_arena_alloc(json->arena, count + 2, LOOKS * sizeof *builder->variants);
    if (!zr_arena_ok(json->arena)) return;
    for (size_t v = 0; v < (count + 2) * LOOKS; v++)
        builder->variants[v] = UINT32_MAX;
    if (count == 0) return;
    size_t faults = json->error->count;
    for (const cJSON *node = list->child; node && !zr_json_full(json); node = node->next, i++) {
        builder->given[i] = (struct zr_given_material){"", i, {1, 1, 1, 1}, ZR_UNSAID, ZR_UNSAID};
        read_material(builder, ZR_JSON_ITEM(path, i), node, &builder->given[i]);
    }
    builder->given_count = i;
    qsort(builder->given, i, sizeof *builder->given, compare_given);
    if (json->error->count == faults) refuse_repeated_names(builder, path);
}

void zr_builder_read_style(struct zr_builder *builder, const struct zr_json_path *path, const cJSON *material,
                           const cJSON *double_sided, const cJSON *shading, struct zr_style *style)
{
    struct zr_json *json = &builder->json;
    const char *name;
    *style = (struct zr_style){builder->given_count, ZR_UNSAID, ZR_UNSAID};
    if (material && zr_json_string(json, ZR_JSON_KEY(path, "material"), material, &name)) {
        const struct zr_given_material *given =
            builder->given_count ? bsearch(name, builder->given, builder->given_count, sizeof *given, compare_name)
                                 : NULL;
        if (given)
            style->given = (size_t)(given - builder->given);
        else
            zr_json_fault(json, ZR_JSON_KEY(path, "material"), "no material has the name %s",
                          zr_quote(name, strlen(name)).text);
    }
    read_double_sided(json, path, double_sided, &style->double_sided);
    read_shading(json, path, shading, &style->shading);
}

static uint32_t add_material(struct zr_builder *builder, struct zr_material material)
{
    if (builder->material_count == builder->material_room) {
        size_t room = builder->material_room ? builder->material_room * 2 : MATERIALS_AT_FIRST;
        struct zr_material *more =
            zr_arena_grow(builder->json.arena, builder->materials, builder->material_count, room, sizeof *more);
        if (!more) return 0;
        builder->materials = more;
        builder->material_room = room;
    }
    builder->materials[builder->material_count] = material;
    return (uint32_t)builder->material_count++;
}

static int first_said(int a, int b, int c, int otherwise)
{
    return a != ZR_UNSAID ? a : b != ZR_UNSAID ? b : c != ZR_UNSAID ? c : otherwise;
}

uint32_t zr_builder_variant(struct zr_builder *builder, const struct zr_style *style, bool coloured, bool smooth)
{
    if (!zr_arena_ok(builder->json.arena)) return 0;
    bool has_given = style->given < builder->given_count;
    const struct zr_given_material none = {"", 0, zr_default_base_color(coloured), ZR_UNSAID, ZR_UNSAID};
    const struct zr_given_material *given = has_given ? &builder->given[style->given] : &none;
    struct zr_material material = {
        given->base_color,
        (enum zr_shading)first_said(style->shading, given->shading, builder->shading, (int)zr_default_shading(smooth)),
        first_said(style->double_sided, given->double_sided, ZR_UNSAID, false) != 0};
    size_t base = has_given ? style->given : builder->given_count + coloured;
    uint32_t *variant = &builder->variants[base * LOOKS + (size_t)material.shading * 2 + material.double_sided];
    if (*variant == UINT32_MAX) *variant = add_material(builder, material);
    return *variant;
}

void zr_builder_note_alpha(struct zr_builder *builder, const zr_vec4 *colors, size_t count)
{
    for (size_t i = 0; i < count && !builder->transparent; i++)
        builder->transparent = colors[i].w < 1.0f;
}
