#include <stdlib.h>
#include <string.h>

#include "input/defaults.h"
#include "input/json_scene.h"
#include "input/text.h"

/* Looks that differ in more than the colour of their outlines. */
enum { SHADINGS = ZR_SHADING_COUNT, OUTLINES = ZR_OUTLINE_COLORED + 1, LOOKS = SHADINGS * OUTLINES * 2 * 2 * 2 };
enum { MATERIALS_AT_FIRST = 16 };

enum { NAME, BASE_COLOR, SPECULAR, SHININESS, LOOK, KEYS = LOOK + ZR_LOOK_KEYS };

/* Of shininess: more than can be told apart at a pixel. */
static const double SHININESS_MAX = 10000.0;

static const char *const words[] = {"name",        "baseColorFactor",  "specular",  "shininess",
                                    ZR_LOOK_WORDS, "baseColorTexture", "alphaMode", "alphaCutoff",
                                    "diffuse",     "emissive"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

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
    if (found[SPECULAR]) zr_json_color(json, ZR_JSON_KEY(path, words[SPECULAR]), found[SPECULAR], &given->specular);
    double shininess = (double)given->shininess;
    if (found[SHININESS] &&
        zr_json_number(json, ZR_JSON_KEY(path, words[SHININESS]), found[SHININESS], 0.0, SHININESS_MAX, &shininess))
        given->shininess = (float)shininess;
    zr_draft_read_look(draft, path, &found[LOOK], ZR_LOOK_KEYS, &given->look);
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
    for (const cJSON *node = list->child; node && !zr_json_full(json) && !zr_json_stopped(json);
         node = node->next, i++) {
        draft->given[i] = (struct zr_given_material){
            .name = "", .number = i, .base_color = {1, 1, 1, 1}, .shininess = ZR_SHININESS, .look = zr_look_unsaid};
        read_material(draft, ZR_JSON_ITEM(path, i), node, &draft->given[i]);
    }
    draft->given_count = i;
    qsort(draft->given, i, sizeof *draft->given, compare_given);
    if (json->error->count == faults) refuse_repeated_names(draft, path);
}

void zr_draft_read_style(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *material,
                         const cJSON *const *look_nodes, struct zr_style *style)
{
    struct zr_json *json = &draft->json;
    const char *name;
    style->given = draft->given_count;
    style->is_open = style->is_plain = false;
    if (material && zr_json_string(json, ZR_JSON_KEY(path, "material"), material, &name)) {
        const struct zr_given_material *given =
            draft->given_count ? bsearch(name, draft->given, draft->given_count, sizeof *given, compare_name) : NULL;
        if (given)
            style->given = (size_t)(given - draft->given);
        else
            zr_json_fault(json, ZR_JSON_KEY(path, "material"), "no material has the name %s",
                          zr_quote(name, strlen(name)).text);
    }
    zr_draft_read_look(draft, path, look_nodes, ZR_LOOK_KEYS, &style->look);
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
    const struct zr_given_material *given = has_given ? &draft->given[style->given] : &none;
    struct zr_look look = zr_look_over(&style->look, &given->look);
    look = zr_look_over(&look, &draft->look);
    if (look.double_sided == ZR_UNSAID) look.double_sided = style->is_open;
    struct zr_material material = zr_look_material(&look, given->base_color, smooth);
    material.specular = (zr_vec3){given->specular.x, given->specular.y, given->specular.z};
    material.shininess = given->shininess;
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
