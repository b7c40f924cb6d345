#include <stdlib.h>
#include <string.h>

#include "input/defaults.h"
#include "input/json_objects.h"
#include "input/json_scene.h"
#include "input/nearest.h"
#include "input/text.h"

/* Of shininess: more than can be told apart at a pixel. */
#define SHININESS_MAX 10000.0

/* ---- looks ---- */

bool zr_read_outline(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                     void *out)
{
    struct zr_face_style *faces = out;
    const enum zr_json_type type = zr_json_type(json);
    if (type == ZR_JSON_BOOL) return zr_json_flag(json, path, field, &faces->outline);
    if (type != ZR_JSON_STRING && type != ZR_JSON_LIST)
        return zr_json_skip(json) && zr_json_fault(json, path, "true, false or a colour is needed");
    if (!zr_json_color(json, path, field, &faces->outline_color)) return false;
    faces->outline = ZR_OUTLINE_SET_COLOR;
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
    ZR_FACE_STYLE_FIELDS(struct zr_given_material, face_style),
    ZR_SIDES_FIELD(struct zr_given_material, face_style),
    {.key = "baseColorTexture"},
    {.key = "alphaMode"},
    {.key = "alphaCutoff"},
    {.key = "diffuse"},
    {.key = "emissive"}};
const struct zr_json_object zr_json_object_material = ZR_JSON_OBJECT_OF("material", fields);

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
    struct zr_given_scene *root = out;
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
                                            .face_style = zr_face_style_unset};
        zr_json_fields(json, ZR_JSON_ITEM(path, list.count), &zr_json_object_material, given, &keys);
        zr_given_note_alpha(root, &given->base_color, 1);
    }
    root->materials = list.items;
    root->material_count = list.count;
    return true;
}

static void refuse_repeated_names(struct zr_given_scene *root, const struct zr_json_path *path)
{
    for (size_t i = 1; i < root->material_count; i++) {
        const struct zr_given_material *before = &root->materials[i - 1], *given = before + 1;
        if (*given->name && strcmp(before->name, given->name) == 0)
            zr_json_fault(&root->json, ZR_JSON_KEY(ZR_JSON_ITEM(path, given->number), fields[NAME].key),
                          "%s is the name of material %zu already", zr_quote(given->name, strlen(given->name)).text,
                          before->number);
    }
}

void zr_given_sort_materials(struct zr_given_scene *root, const struct zr_json_path *path)
{
    if (root->material_count > 0) qsort(root->materials, root->material_count, sizeof *root->materials, compare_given);
    refuse_repeated_names(root, path);
}

size_t zr_given_find_material(struct zr_given_scene *root, const struct zr_json_path *path, const char *name)
{
    const struct zr_given_material *given =
        root->material_count == 0 ? NULL
                                  : bsearch(name, root->materials, root->material_count, sizeof *given, compare_name);
    if (given) return (size_t)(given - root->materials);
    struct zr_nearest nearest = {.word = name};
    for (size_t i = 0; i < root->material_count; i++)
        zr_nearest_offer(&nearest, root->materials[i].name);
    zr_json_fault(&root->json, path, "no material has the name %s%s", zr_quote(name, strlen(name)).text,
                  zr_nearest_text(&nearest).text);
    return root->material_count;
}

/* ---- materials as they are drawn ---- */

uint32_t zr_given_make_material(struct zr_given_scene *root, const struct zr_style *style, bool coloured, bool smooth)
{
    bool has_given = style->material < root->material_count;
    const struct zr_given_material none = {
        .name = "", .base_color = zr_default_base_color(coloured), .face_style = zr_face_style_unset};
    const struct zr_given_material *given = has_given ? &root->materials[style->material] : &none;
    struct zr_face_style faces = zr_face_style_merge(&style->face_style, &given->face_style);
    faces = zr_face_style_merge(&faces, &root->face_style);
    if (faces.double_sided == ZR_UNSET) faces.double_sided = style->is_open;
    struct zr_material material = zr_face_style_material(&faces, given->base_color, smooth);
    material.specular = (zr_vec3){given->specular.x, given->specular.y, given->specular.z};
    material.shininess = given->shininess;
    zr_given_note_alpha(root, &material.outline_color, 1);
    material.uniform_color = style->is_uniform && material.shading == ZR_SHADING_UNLIT;
    return zr_scene_builder_material(root->builder, &material);
}

void zr_given_note_alpha(struct zr_given_scene *root, const zr_vec4 *colors, size_t count)
{
    for (size_t i = 0; i < count && !root->transparent; i++)
        root->transparent = colors[i].w < 1.0f;
}
