#include <stdlib.h>
#include <string.h>

#include "input/defaults.h"
#include "input/json_scene.h"
#include "input/nearest.h"
#include "input/text.h"

/* Looks that differ in more than the colour of their outlines. */
enum { SHADINGS = ZR_SHADING_COUNT, OUTLINES = ZR_OUTLINE_COLORED + 1, LOOKS = SHADINGS * OUTLINES * 2 * 2 * 2 };
enum { MATERIALS_AT_FIRST = 16 };

/* Of shininess: more than can be told apart at a pixel. */
#define SHININESS_MAX 10000.0

/* ---- looks ---- */

bool zr_read_outline(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                     void *out)
{
    struct zr_look *look = out;
    const enum zr_json_type type = zr_json_type(json);
    if (type == ZR_JSON_BOOL) return zr_json_flag(json, path, field, &look->outline);
    if (type != ZR_JSON_STRING && type != ZR_JSON_LIST)
        return zr_json_skip(json) && zr_json_fault(json, path, "true, false or a colour is needed");
    if (!zr_json_color(json, path, field, &look->outline_color)) return false;
    look->outline = ZR_OUTLINE_SAID_IN_COLOR;
    return true;
}

/* ---- materials as they are given ---- */

enum { NAME, BASE_COLOR };
#define AT(member) offsetof(struct zr_given_material, member)
static const struct zr_json_field fields[] = {
    [NAME] = {"name", zr_json_string, AT(name), .required = true, .text = "it is asked for by its name"},
    [BASE_COLOR] = {"baseColorFactor", zr_json_color, AT(base_color), .otherwise = "white",
                    .text = "multiplies the colours of what is drawn"},
    {"specular", zr_json_color, AT(specular), .otherwise = "black", .text = "the colour of highlights"},
    {"shininess", zr_json_float, AT(shininess), 0, SHININESS_MAX, .otherwise = "32",
     .text = "how narrow highlights are: the exponent"},
    ZR_LOOK_FIELDS(struct zr_given_material, look),
    ZR_SIDES_FIELD(struct zr_given_material, look),
    {.key = "baseColorTexture"},
    {.key = "alphaMode"},
    {.key = "alphaCutoff"},
    {.key = "diffuse"},
    {.key = "emissive"}};
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("material", fields);

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

bool zr_read_materials(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                       void *out)
{
    struct zr_draft *draft = out;
    struct zr_growing list = {.size = sizeof(struct zr_given_material)};
    uint64_t keys;
    (void)field;
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_item(json); list.count++) {
        struct zr_given_material *given = zr_growing_next(&list, json);
        if (!given) return false;
        *given = (struct zr_given_material){.name = "",
                                            .number = list.count,
                                            .base_color = {1, 1, 1, 1},
                                            .shininess = ZR_SHININESS,
                                            .look = zr_look_unsaid};
        zr_json_fields(json, ZR_JSON_ITEM(path, list.count), &object, given, &keys);
        zr_draft_note_alpha(draft, &given->base_color, 1);
    }
    draft->materials_given = list.items;
    draft->given_count = list.count;
    return true;
}

static void refuse_repeated_names(struct zr_draft *draft, const struct zr_json_path *path)
{
    for (size_t i = 1; i < draft->given_count; i++) {
        const struct zr_given_material *before = &draft->materials_given[i - 1], *given = before + 1;
        if (*given->name && strcmp(before->name, given->name) == 0)
            zr_json_fault(&draft->json, ZR_JSON_KEY(ZR_JSON_ITEM(path, given->number), fields[NAME].key),
                          "%s is the name of material %zu already", zr_quote(given->name, strlen(given->name)).text,
                          before->number);
    }
}

void zr_draft_open_materials(struct zr_draft *draft, const struct zr_json_path *path)
{
    struct zr_arena *arena = draft->json.arena;
    if (draft->given_count > 0)
        qsort(draft->materials_given, draft->given_count, sizeof *draft->materials_given, compare_given);
    refuse_repeated_names(draft, path);
    /* Behind the given ones come two of our own: for what has colours, and for what has none. */
    const size_t count = draft->given_count + 2;
    draft->variants = zr_arena_alloc(arena, count, LOOKS * sizeof *draft->variants);
    for (size_t v = 0; draft->variants && v < count * LOOKS; v++)
        draft->variants[v] = UINT32_MAX;
}

size_t zr_draft_find_material(struct zr_draft *draft, const struct zr_json_path *path, const char *name)
{
    const struct zr_given_material *given =
        draft->given_count == 0
            ? NULL
            : bsearch(name, draft->materials_given, draft->given_count, sizeof *given, compare_name);
    if (given) return (size_t)(given - draft->materials_given);
    struct zr_nearest nearest = {.word = name};
    for (size_t i = 0; i < draft->given_count; i++)
        zr_nearest_offer(&nearest, draft->materials_given[i].name);
    zr_json_fault(&draft->json, path, "no material has the name %s%s", zr_quote(name, strlen(name)).text,
                  zr_nearest_text(&nearest).text);
    return draft->given_count;
}

/* ---- materials as they are drawn ---- */

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

/* Where it is kept that the material has been made: NULL for one with a colour of its own for outlines. */
static uint32_t *slot_of(const struct zr_draft *draft, size_t base, const struct zr_material *material, bool own_color)
{
    size_t look = (size_t)material->shading * OUTLINES + (size_t)material->outline;
    look = look * 8 + material->plain * 4 + material->hollow * 2 + material->double_sided;
    return own_color ? NULL : &draft->variants[base * LOOKS + look];
}

/* Of those with colours of their own only the last is remembered: neighbours mostly look alike. */
static bool is_last(const struct zr_draft *draft, const struct zr_material *m)
{
    if (draft->material_count == 0) return false;
    const struct zr_material *last = &draft->materials[draft->material_count - 1];
    return last->shading == m->shading && last->double_sided == m->double_sided && last->hollow == m->hollow &&
           last->plain == m->plain && last->outline == m->outline && zr_vec4_equal(last->base_color, m->base_color) &&
           last->shininess == m->shininess && last->specular.x == m->specular.x && last->specular.y == m->specular.y &&
           last->specular.z == m->specular.z && zr_vec4_equal(last->outline_color, m->outline_color);
}

uint32_t zr_draft_variant(struct zr_draft *draft, const struct zr_style *style, bool coloured, bool smooth)
{
    if (!zr_arena_ok(draft->json.arena)) return 0;
    bool has_given = style->given < draft->given_count;
    const struct zr_given_material none = {
        .name = "", .base_color = zr_default_base_color(coloured), .look = zr_look_unsaid};
    const struct zr_given_material *given = has_given ? &draft->materials_given[style->given] : &none;
    struct zr_look look = zr_look_over(&style->look, &given->look);
    look = zr_look_over(&look, &draft->look);
    if (look.double_sided == ZR_UNSAID) look.double_sided = style->is_open;
    struct zr_material material = zr_look_material(&look, given->base_color, smooth);
    material.specular = (zr_vec3){given->specular.x, given->specular.y, given->specular.z};
    material.shininess = given->shininess;
    zr_draft_note_alpha(draft, &material.outline_color, 1);
    material.plain = style->is_plain && material.shading == ZR_SHADING_UNLIT;
    bool black = zr_vec4_equal(material.outline_color, (zr_vec4){0, 0, 0, 1});
    uint32_t *slot = slot_of(draft, has_given ? style->given : draft->given_count + coloured, &material, !black);
    if (!slot) return is_last(draft, &material) ? (uint32_t)draft->material_count - 1 : add_material(draft, material);
    if (*slot == UINT32_MAX) *slot = add_material(draft, material);
    return *slot;
}

void zr_draft_note_alpha(struct zr_draft *draft, const zr_vec4 *colors, size_t count)
{
    for (size_t i = 0; i < count && !draft->transparent; i++)
        draft->transparent = colors[i].w < 1.0f;
}
