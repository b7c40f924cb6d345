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

static void read_material(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                          struct zr_given_material *given)
{
    struct zr_json *json = &draft->json;
    const cJSON *found[KEYS];
    if (!zr_json_object(json, path, node, &keys, found)) return;
    if (!found[NAME])
        zr_json_fault(json, path, "a material needs a name to be asked for by");
    else if (!zr_json_string(json, ZR_JSON_KEY(path, words[NAME]), found[NAME], &given->name))
        given->name = "";
    if (found[BASE_COLOR] &&
        zr_json_color(json, ZR_JSON_KEY(path, words[BASE_COLOR]), found[BASE_COLOR], &given->base_color))
        zr_draft_note_alpha(draft, &given->base_color, 1);
    read_double_sided(json, path, found[DOUBLE_SIDED], &given->double_sided);
    read_shading(json, path, found[SHADING], &given->shading);
}

static void refuse_repeated_names(struct zr_draft *draft, const struct zr_json_path *path)
{
    for (size_t i = 1; i < draft->given_count && !zr_json_full(&draft->json); i++) {
        const struct zr_given_material *before = &draft->given[i - 1], *given = &draft->given[i];
        if (strcmp(before->name, given->name) == 0)
            zr_json_fault(&draft->json, ZR_JSON_KEY(ZR_JSON_ITEM(path, given->number), words[NAME]),
                          "%s is the name of material %zu already", zr_quote(given->name, strlen(given->name)).text,
                          before->number);
    }
}

void zr_draft_read_materials(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list)
{
    struct zr_json *json = &draft->json;
    size_t count = 0, i = 0;
    if (list && !zr_json_array(json, path, list, &count)) list = NULL;
    draft->given = zr_arena_alloc(json->arena, count, sizeof *draft->given);
    /* Behind the given ones come two of our own: for what has colours, and for what has none. */
    draft->variants = zr_arena_alloc(json->arena, count + 2, LOOKS * sizeof *draft->variants);
    if (!zr_arena_ok(json->arena)) return;
    for (size_t v = 0; v < (count + 2) * LOOKS; v++)
        draft->variants[v] = UINT32_MAX;
    if (count == 0) return;
    size_t faults = json->error->count;
    for (const cJSON *node = list->child; node && !zr_json_full(json); node = node->next, i++) {
        draft->given[i] = (struct zr_given_material){"", i, {1, 1, 1, 1}, ZR_UNSAID, ZR_UNSAID};
        read_material(draft, ZR_JSON_ITEM(path, i), node, &draft->given[i]);
    }
    draft->given_count = i;
    qsort(draft->given, i, sizeof *draft->given, compare_given);
    if (json->error->count == faults) refuse_repeated_names(draft, path);
}

void zr_draft_read_style(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *material,
                         const cJSON *double_sided, const cJSON *shading, struct zr_style *style)
{
    struct zr_json *json = &draft->json;
    const char *name;
    *style = (struct zr_style){draft->given_count, ZR_UNSAID, ZR_UNSAID, false};
    if (material && zr_json_string(json, ZR_JSON_KEY(path, "material"), material, &name)) {
        const struct zr_given_material *given =
            draft->given_count ? bsearch(name, draft->given, draft->given_count, sizeof *given, compare_name) : NULL;
        if (given)
            style->given = (size_t)(given - draft->given);
        else
            zr_json_fault(json, ZR_JSON_KEY(path, "material"), "no material has the name %s",
                          zr_quote(name, strlen(name)).text);
    }
    read_double_sided(json, path, double_sided, &style->double_sided);
    read_shading(json, path, shading, &style->shading);
}

static uint32_t add_material(struct zr_draft *draft, struct zr_material material)
{
    if (draft->material_count == draft->material_room) {
        size_t room = draft->material_room ? draft->material_room * 2 : MATERIALS_AT_FIRST;
        struct zr_material *more =
            zr_arena_grow(draft->json.arena, draft->materials, draft->material_count, room, sizeof *more);
        if (!more) return 0;
        draft->materials = more;
        draft->material_room = room;
    }
    draft->materials[draft->material_count] = material;
    return (uint32_t)draft->material_count++;
}

static int first_said(int a, int b, int c, int otherwise)
{
    return a != ZR_UNSAID ? a : b != ZR_UNSAID ? b : c != ZR_UNSAID ? c : otherwise;
}

uint32_t zr_draft_variant(struct zr_draft *draft, const struct zr_style *style, bool coloured, bool smooth)
{
    if (!zr_arena_ok(draft->json.arena)) return 0;
    bool has_given = style->given < draft->given_count;
    const struct zr_given_material none = {"", 0, zr_default_base_color(coloured), ZR_UNSAID, ZR_UNSAID};
    const struct zr_given_material *given = has_given ? &draft->given[style->given] : &none;
    struct zr_material material = {
        given->base_color,
        (enum zr_shading)first_said(style->shading, given->shading, draft->shading, (int)zr_default_shading(smooth)),
        first_said(style->double_sided, given->double_sided, ZR_UNSAID, style->is_open) != 0};
    size_t base = has_given ? style->given : draft->given_count + coloured;
    uint32_t *variant = &draft->variants[base * LOOKS + (size_t)material.shading * 2 + material.double_sided];
    if (*variant == UINT32_MAX) *variant = add_material(draft, material);
    return *variant;
}

void zr_draft_note_alpha(struct zr_draft *draft, const zr_vec4 *colors, size_t count)
{
    for (size_t i = 0; i < count && !draft->transparent; i++)
        draft->transparent = colors[i].w < 1.0f;
}
