#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/rgba.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/scene/resolved_material.h"
#include "input/text/names.h"
#include "input/text/nearest.h"
#include "input/text/parameter_names.h"
#include "input/text/text.h"
#include "scene/defaults.h"
#include "scene/picture.h"

/* The exponent of highlights: larger values look the same at a pixel. */
#define SHININESS_MAX 10000.0

#define EMISSIVE_MAX 1e6
#define IOR_MAX      100.0
#define ROTATION_MAX 1e6

/* ---- outlines ---- */

bool zr_read_outline(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_face_style *faces = out;
    const enum zr_json_type type = zr_json_type(json);
    if (type == ZR_JSON_BOOL) return zr_json_flag(json, path, &faces->outline);
    if (type != ZR_JSON_STRING && type != ZR_JSON_LIST)
        return zr_json_skip(json) && zr_json_fault(json, path, "true, false or a colour is needed");
    if (!zr_json_color(json, path, &faces->outline_color)) return false;
    faces->outline = ZR_OUTLINE_SET_COLOR;
    return true;
}

/* ---- materials as read ---- */

/* zr_vec3: linear light, so a text is not allowed. */
static bool read_emissive(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double v[3] = {0};
    const struct zr_json_row row = {3, 3, path->field->low, path->field->high};
    if (!zr_json_numbers(json, path, row, v, NULL)) return false;
    *(zr_vec3 *)out = (zr_vec3){(float)v[0], (float)v[1], (float)v[2]};
    return true;
}

#define AT(member) offsetof(struct zr_parsed_material, member)
static const struct zr_json_field fields[] = {
    [ZR_MATERIAL_NAME] = {"name", zr_json_string, AT(name), .required = true,
                          .text = "name by which meshes and polygons refer to the material"},
    [ZR_MATERIAL_BASE_COLOR] = {"baseColorFactor", zr_json_color, AT(base_color), .otherwise = "the look's; white",
                                .text = "colour, a factor of vertex and face colours"},
    [ZR_MATERIAL_SPECULAR] = {"specular", zr_read_light_color, AT(specular), .otherwise = "the look's; black",
                              .text = "colour of highlights"},
    [ZR_MATERIAL_SHININESS] = {"shininess", zr_json_float, AT(shininess), 0, SHININESS_MAX,
                               .otherwise = "the look's; 32", .text = "exponent of highlights; larger is narrower"},
    [ZR_MATERIAL_METALLIC] = {"metallicFactor", zr_json_float, AT(metallic), 0, 1, .otherwise = "the look's; 0",
                              .text = "pbr: metalness, 0 (plastic) to 1 (metal)"},
    [ZR_MATERIAL_ROUGHNESS] = {"roughnessFactor", zr_json_float, AT(roughness), 0, 1, .otherwise = "the look's; 0.55",
                               .text = "pbr: roughness, 0 (mirror) to 1 (matt)"},
    [ZR_MATERIAL_IOR] = {"ior", zr_json_float, AT(ior), 1, IOR_MAX, .otherwise = "1.5",
                         .text = "pbr: index of refraction of plastics"},
    [ZR_MATERIAL_SPECULAR_FACTOR] = {"specularFactor", zr_json_float, AT(specular_factor), 0, 1, .otherwise = "1",
                                     .text = "pbr: factor of the reflection of plastics"},
    [ZR_MATERIAL_SPECULAR_COLOR] = {"specularColorFactor", read_emissive, AT(specular_color), 0, EMISSIVE_MAX,
                                    .otherwise = "[1, 1, 1]",
                                    .text = "pbr: colour of the reflection of plastics, linear",
                                    .schema = ZR_SCHEMA_OF("linearColor")},
    [ZR_MATERIAL_EMISSIVE] = {"emissiveFactor", read_emissive, AT(emissive), 0, EMISSIVE_MAX, .otherwise = "[0, 0, 0]",
                              .text = "pbr: emitted light, linear", .schema = ZR_SCHEMA_OF("linearColor")},
    [ZR_MATERIAL_COOL] = {"cool", zr_json_color, AT(cool), .otherwise = "the look's; #9fb0c3",
                          .text = "gooch: colour of faces that face away from the light"},
    [ZR_MATERIAL_METALLIC_ROUGHNESS_TEXTURE] = {"metallicRoughnessTexture", zr_read_texture,
                                                AT(textures[ZR_TEXTURE_METALLIC_ROUGHNESS]), .otherwise = "none",
                                                .text = "pbr: factors of roughness (green) and metalness (blue)"},
    [ZR_MATERIAL_NORMAL_TEXTURE] = {"normalTexture", zr_read_normal_texture, AT(textures[ZR_TEXTURE_NORMAL]),
                                    .otherwise = "none", .text = "normal map, as in glTF"},
    [ZR_MATERIAL_OCCLUSION_TEXTURE] = {"occlusionTexture", zr_read_occlusion_texture,
                                       AT(textures[ZR_TEXTURE_OCCLUSION]), .otherwise = "none",
                                       .text = "share of ambient light, in red"},
    [ZR_MATERIAL_EMISSIVE_TEXTURE] = {"emissiveTexture", zr_read_texture, AT(textures[ZR_TEXTURE_EMISSIVE]),
                                      .otherwise = "none", .text = "pbr: factor of emissiveFactor"},
    [ZR_MATERIAL_COAT] = {"clearcoatFactor", zr_json_float, AT(finish.coat), 0, 1, .otherwise = "0",
                          .text = "pbr: share of the surface with a clear coat"},
    [ZR_MATERIAL_COAT_ROUGHNESS] = {"clearcoatRoughnessFactor", zr_json_float, AT(finish.coat_roughness), 0, 1,
                                    .otherwise = "0", .text = "pbr: roughness of the clear coat"},
    [ZR_MATERIAL_COAT_TEXTURE] = {"clearcoatTexture", zr_read_texture, AT(textures[ZR_TEXTURE_COAT]),
                                  .otherwise = "none", .text = "pbr: factor of clearcoatFactor, in red"},
    [ZR_MATERIAL_COAT_ROUGHNESS_TEXTURE] = {"clearcoatRoughnessTexture", zr_read_texture,
                                            AT(textures[ZR_TEXTURE_COAT_ROUGHNESS]), .otherwise = "none",
                                            .text = "pbr: factor of clearcoatRoughnessFactor, in green"},
    [ZR_MATERIAL_COAT_NORMAL_TEXTURE] = {"clearcoatNormalTexture", zr_read_normal_texture,
                                         AT(textures[ZR_TEXTURE_COAT_NORMAL]), .otherwise = "none",
                                         .text = "pbr: normal map of the clear coat"},
    [ZR_MATERIAL_SHEEN] = {"sheenColorFactor", read_emissive, AT(finish.sheen), 0, 1, .otherwise = "[0, 0, 0]",
                           .text = "pbr: colour of sheen, as of cloth, linear", .schema = ZR_SCHEMA_OF("rgb")},
    [ZR_MATERIAL_SHEEN_ROUGHNESS] = {"sheenRoughnessFactor", zr_json_float, AT(finish.sheen_roughness), 0, 1,
                                     .otherwise = "0", .text = "pbr: roughness of sheen"},
    [ZR_MATERIAL_SHEEN_TEXTURE] = {"sheenColorTexture", zr_read_texture, AT(textures[ZR_TEXTURE_SHEEN]),
                                   .otherwise = "none", .text = "pbr: factor of sheenColorFactor"},
    [ZR_MATERIAL_FILM] = {"iridescenceFactor", zr_json_float, AT(finish.film), 0, 1, .otherwise = "0",
                          .text = "pbr: share of the surface with a thin film"},
    [ZR_MATERIAL_FILM_IOR] = {"iridescenceIor", zr_json_float, AT(finish.film_ior), 1, IOR_MAX, .otherwise = "1.3",
                              .text = "pbr: index of refraction of the film"},
    [ZR_MATERIAL_FILM_THICKNESS] = {"iridescenceThickness", zr_json_float, AT(finish.film_nm), 0, ZR_FILM_NM_MAX,
                                    .otherwise = "400", .text = "pbr: thickness of the film", .unit = "nm"},
    [ZR_MATERIAL_FILM_THINNEST] = {"iridescenceThicknessMinimum", zr_json_float, AT(finish.film_thinnest), 0,
                                   ZR_FILM_NM_MAX, .otherwise = "100",
                                   .text = "pbr: thickness where iridescenceThicknessTexture is 0", .unit = "nm"},
    [ZR_MATERIAL_FILM_TEXTURE] = {"iridescenceTexture", zr_read_texture, AT(textures[ZR_TEXTURE_FILM]),
                                  .otherwise = "none", .text = "pbr: factor of iridescenceFactor, in red"},
    [ZR_MATERIAL_FILM_THICKNESS_TEXTURE] = {"iridescenceThicknessTexture", zr_read_texture,
                                            AT(textures[ZR_TEXTURE_FILM_THICKNESS]), .otherwise = "none",
                                            .text = "pbr: thickness of the film, in green: 1 is iridescenceThickness"},
    [ZR_MATERIAL_ANISOTROPY] = {"anisotropyStrength", zr_json_float, AT(finish.anisotropy), 0, 1, .otherwise = "0",
                                .text = "pbr: length of highlights, as on brushed metal"},
    [ZR_MATERIAL_ANISOTROPY_ROTATION] = {"anisotropyRotation", zr_json_number, AT(anisotropy_rotation), -ROTATION_MAX,
                                         ROTATION_MAX, .otherwise = "0",
                                         .text =
                                             "pbr: direction of long highlights, from the tangent, counter-clockwise",
                                         .unit = "rad"},
    [ZR_MATERIAL_ANISOTROPY_TEXTURE] = {"anisotropyTexture", zr_read_texture, AT(textures[ZR_TEXTURE_ANISOTROPY]),
                                        .otherwise = "none",
                                        .text = "pbr: direction (red, green) and factor of anisotropyStrength (blue)"},
    [ZR_MATERIAL_TRANSMISSION] = {"transmissionFactor", zr_json_float, AT(finish.transmission), 0, 1, .otherwise = "0",
                                  .text = "pbr: share of the light that passes through"},
    [ZR_MATERIAL_TRANSMISSION_TEXTURE] = {"transmissionTexture", zr_read_texture, AT(textures[ZR_TEXTURE_TRANSMISSION]),
                                          .otherwise = "none", .text = "pbr: factor of transmissionFactor, in red"},
    [ZR_MATERIAL_THICKNESS] = {"thicknessFactor", zr_json_float, AT(finish.thickness), 0, ZR_VOLUME_MAX,
                               .otherwise = "0", .text = "pbr: length of rays in glass, in units of the mesh"},
    [ZR_MATERIAL_THICKNESS_TEXTURE] = {"thicknessTexture", zr_read_texture, AT(textures[ZR_TEXTURE_THICKNESS]),
                                       .otherwise = "none", .text = "pbr: factor of thicknessFactor, in green"},
    [ZR_MATERIAL_ATTENUATION_COLOR] = {"attenuationColor", read_emissive, AT(finish.attenuation), 0, 1,
                                       .otherwise = "[1, 1, 1]",
                                       .text = "pbr: colour of white light after attenuationDistance, linear",
                                       .schema = ZR_SCHEMA_OF("rgb")},
    [ZR_MATERIAL_ATTENUATION_DISTANCE] = {"attenuationDistance", zr_json_float, AT(finish.distance), 0, ZR_VOLUME_MAX,
                                          .otherwise = "0",
                                          .text = "pbr: distance in glass of attenuationColor; 0: no attenuation"},
    [ZR_MATERIAL_DISPERSION] = {"dispersion", zr_json_float, AT(finish.dispersion), 0, ZR_DISPERSION_MAX,
                                .otherwise = "0", .text = "pbr: dispersion of glass, 20 / Abbe number"},
    [ZR_MATERIAL_BASE_COLOR_TEXTURE] = {"baseColorTexture", zr_read_texture, AT(textures[ZR_TEXTURE_BASE_COLOR]),
                                        .otherwise = "none", .text = "factor of the colours of faces"},
    ZR_FACE_STYLE_FIELDS(struct zr_parsed_material, face_style),
    ZR_SIDES_FIELD(struct zr_parsed_material, face_style),
    {.key = "diffuse"},
    {.key = "emissive"}};
const struct zr_json_object zr_json_object_material = ZR_JSON_OBJECT_OF("material", fields);

/* Equal names stay in the scene's order, so that the later one is reported. */
static int compare_given(const void *left, const void *right)
{
    const struct zr_parsed_material *a = left, *b = right;
    int order = strcmp(a->name, b->name);
    return order != 0 ? order : a->number < b->number ? -1 : a->number > b->number;
}

static int compare_name(const void *name, const void *given)
{
    return strcmp(name, ((const struct zr_parsed_material *)given)->name);
}

/* Notes keys that need linear light. */
static void note_linear_keys(struct zr_parsed_scene *root, uint64_t keys)
{
    for (int key = ZR_MATERIAL_METALLIC; key < ZR_MATERIAL_BASE_COLOR_TEXTURE && !root->linear_key; key++)
        if (zr_json_gives(keys, key)) root->linear_key = fields[key].key;
}

/* The word is about materials of model files. */
bool zr_read_materials(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_growing list = {.size = sizeof(struct zr_parsed_material)};
    if (zr_json_type(json) == ZR_JSON_STRING) return zr_json_choice(json, path, &root->keeps_materials);
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_item(json); list.count++) {
        struct zr_parsed_material *given = zr_growing_next(&list, json);
        if (!given) return false;
        *given = (struct zr_parsed_material){
            .name = "", .number = list.count, .base_color = {1, 1, 1, 1}, .face_style = zr_face_style_unset};
        zr_json_fields(json, ZR_JSON_ITEM(path, list.count), &zr_json_object_material, given, &given->keys);
        note_linear_keys(root, given->keys);
    }
    root->materials = list.items;
    root->material_count = list.count;
    return true;
}

static void refuse_repeated_names(struct zr_parsed_scene *root, const struct zr_json_path *path)
{
    for (size_t i = 1; i < root->material_count; i++) {
        const struct zr_parsed_material *before = &root->materials[i - 1], *given = before + 1;
        if (*given->name && strcmp(before->name, given->name) == 0)
            zr_json_fault(&root->json, ZR_JSON_KEY(ZR_JSON_ITEM(path, given->number), fields[ZR_MATERIAL_NAME].key),
                          "%s is the name of material %zu already", zr_quote(given->name, strlen(given->name)).text,
                          before->number);
    }
}

void zr_parsed_sort_materials(struct zr_parsed_scene *root, const struct zr_json_path *path)
{
    if (root->material_count > 0) qsort(root->materials, root->material_count, sizeof *root->materials, compare_given);
    refuse_repeated_names(root, path);
}

size_t zr_parsed_find_material(struct zr_parsed_scene *root, const struct zr_json_path *path, const char *name)
{
    const struct zr_parsed_material *given =
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

/* ---- oddities ---- */

/* Returns the shadings that use a key, one bit each; 0: all draws use it, lines too. */
static uint32_t shadings_of(int key)
{
    const uint32_t by_nothing = zr_shadings_lit(ZR_SHADED_BY_NOTHING),
                   by_normals = zr_shadings_lit(ZR_SHADED_BY_NORMALS);
    if (key >= ZR_MATERIAL_FINISH_FIRST && key <= ZR_MATERIAL_FINISH_LAST) return zr_shadings_lit(ZR_SHADED_PHYSICALLY);
    switch (key) {
    case ZR_MATERIAL_SPECULAR:
    case ZR_MATERIAL_SHININESS:
        return ZR_SHADINGS_SPECULAR;
    case ZR_MATERIAL_METALLIC:
    case ZR_MATERIAL_ROUGHNESS:
    case ZR_MATERIAL_IOR:
    case ZR_MATERIAL_SPECULAR_FACTOR:
    case ZR_MATERIAL_SPECULAR_COLOR:
    case ZR_MATERIAL_EMISSIVE:
    case ZR_MATERIAL_METALLIC_ROUGHNESS_TEXTURE:
    case ZR_MATERIAL_EMISSIVE_TEXTURE:
        return zr_shadings_lit(ZR_SHADED_PHYSICALLY);
    case ZR_MATERIAL_COOL:
        return zr_shadings_lit(ZR_SHADED_BY_OWN_LAMP);
    case ZR_MATERIAL_NORMAL_TEXTURE:
        return ZR_SHADING_ALL & ~by_nothing;
    case ZR_MATERIAL_OCCLUSION_TEXTURE:
        return ZR_SHADING_ALL & ~(by_nothing | by_normals);
    case ZR_MATERIAL_BASE_COLOR_TEXTURE:
        return ZR_SHADING_ALL & ~by_normals;
    default:
        return 0;
    }
}

static void note(struct zr_parsed_scene *root, const struct zr_style *style, enum zr_oddity oddity)
{
    zr_parsed_note_oddity(root, oddity, style->number, style->is_polygon);
}

/* `faces`: the styles of the mesh, its material and the scene, merged. */
static void note_oddities(struct zr_parsed_scene *root, const struct zr_style *style, const struct zr_face_style *faces,
                          const struct zr_material *material)
{
    const bool has_outline = material->outline == ZR_OUTLINE_COLORED;
    const float least = style->alpha.least * material->base_color.w, most = style->alpha.most * material->base_color.w;
    if (style->face_style.alpha_cutoff >= 0.0f && material->alpha_mode != ZR_ALPHA_MASK)
        note(root, style, ZR_ODD_CUTOFF);
    const bool has_mode = faces->alpha_mode != ZR_UNSET || zr_shading_is_layered(material->shading);
    const bool is_textured = style->has_faces && !material->unfilled &&
                             zr_shading_is_in(material->shading, shadings_of(ZR_MATERIAL_BASE_COLOR_TEXTURE));
    const uint32_t texture = is_textured ? material->textures[ZR_TEXTURE_BASE_COLOR] : 0;
    if (!has_mode && texture && least >= 1.0f &&
        !zr_image_list_is_opaque(&root->images, root->scene->textures[texture - 1].image))
        note(root, style, ZR_ODD_TEXTURE_ALPHA);
    if (!has_mode && (least < 1.0f || (has_outline && material->outline_color.w < 1.0f)))
        note(root, style, ZR_ODD_ALPHA);
    if (style->has_faces && !material->unfilled) root->shadings |= 1u << material->shading;
    if (has_outline) return; /* its outline is visible: it has its own colour */
    if (material->alpha_mode == ZR_ALPHA_BLEND && most <= 0.0f) note(root, style, ZR_ODD_UNSEEN);
    if (material->alpha_mode == ZR_ALPHA_MASK && zr_rgba_byte(most) < zr_rgba_byte(material->alpha_cutoff))
        note(root, style, ZR_ODD_MASKED);
}

static void note_use(struct zr_parsed_material *given, const struct zr_style *style, const struct zr_material *material)
{
    given->is_used = true;
    given->is_masked |= material->alpha_mode == ZR_ALPHA_MASK;
    given->is_blended |= material->alpha_mode == ZR_ALPHA_BLEND;
    if (style->has_faces && !material->unfilled) given->shadings |= 1u << material->shading;
}

/* Lists the keys of a material that its meshes do not use. In linear light, BLEND uses the alpha of a texture with
 * every shading. */
static struct zr_names_text unused_keys(const struct zr_parsed_material *given, bool is_linear)
{
    struct zr_names_text words = {""};
    for (int key = 0; given->is_used && key <= ZR_MATERIAL_BASE_COLOR_TEXTURE; key++) {
        const bool any_shading = key == ZR_MATERIAL_BASE_COLOR_TEXTURE && given->is_blended && is_linear;
        const uint32_t users = any_shading ? ZR_SHADING_ALL : shadings_of(key);
        if (zr_json_gives(given->keys, key) && users != 0 && !(users & given->shadings))
            zr_names_text_add(&words, fields[key].key);
    }
    return words;
}

/* Formats "with the shading phong", or "without filled faces". */
static struct zr_names_text shadings_in_words(const struct zr_parsed_material *given)
{
    if (given->shadings == 0) return (struct zr_names_text){"without filled faces"};
    struct zr_names_text all;
    snprintf(all.text, sizeof all.text, "with the shading %.100s",
             zr_names_join_set(&zr_shading_names, given->shadings).text);
    return all;
}

/* "" or " (and 3 more)". */
struct more {
    char text[40];
};

static struct more more_than_one(size_t count)
{
    struct more more = {""};
    if (count > 1) snprintf(more.text, sizeof more.text, " (and %zu more)", count - 1);
    return more;
}

/* A set of materials: its size, and its first member. */
struct some {
    const struct zr_parsed_material *first;
    size_t count;
};

/* `first` is the first in the scene; the array is sorted by name. */
static void add_to(struct some *some, const struct zr_parsed_material *given)
{
    if (some->count++ == 0 || given->number < some->first->number) some->first = given;
}

static void warn_of(struct zr_parsed_scene *root, const struct some *some, const char *text)
{
    if (some->count > 0)
        zr_warning_list_add(root->json.arena, &root->builder->color_warnings, "material %s%s%s",
                            zr_quote(some->first->name, strlen(some->first->name)).text,
                            more_than_one(some->count).text, text);
}

void zr_parsed_warn_of_materials(struct zr_parsed_scene *root)
{
    const bool is_linear = root->scene->picture->is_linear;
    struct some idle = {NULL, 0}, uncut = {NULL, 0}, odd = {NULL, 0};
    for (size_t i = 0; i < root->material_count; i++) {
        const struct zr_parsed_material *given = &root->materials[i];
        if (!given->is_used) add_to(&idle, given);
        if (given->is_used && given->face_style.alpha_cutoff >= 0.0f && !given->is_masked) add_to(&uncut, given);
        if (*unused_keys(given, is_linear).text) add_to(&odd, given);
    }
    warn_of(root, &idle, " is used by nothing");
    warn_of(root, &uncut, ": alphaCutoff has no effect without \"alphaMode\": \"MASK\"");
    if (odd.count == 0) return;
    if (root->is_bare) {
        zr_warning_list_add(root->json.arena, &root->builder->color_warnings, "no effect of %s %s",
                            zr_parameter_names("/materials/0", unused_keys(odd.first, is_linear).text).text,
                            shadings_in_words(odd.first).text);
        return;
    }
    char text[2 * sizeof(struct zr_names_text) + 32];
    snprintf(text, sizeof text, ": no effect of %s %s", unused_keys(odd.first, is_linear).text,
             shadings_in_words(odd.first).text);
    warn_of(root, &odd, text);
}

uint32_t zr_parsed_make_material(struct zr_parsed_scene *root, const struct zr_style *style, bool coloured, bool smooth)
{
    const struct zr_look *look = root->scene->look;
    bool has_given = style->material < root->material_count;
    const struct zr_parsed_material none = {
        .name = "", .base_color = zr_default_base_color(look, coloured), .face_style = zr_face_style_unset};
    const struct zr_parsed_material *given = has_given ? &root->materials[style->material] : &none;
    const bool has_color = zr_json_gives(given->keys, ZR_MATERIAL_BASE_COLOR) ||
                           (has_given && look == zr_look_textbook() && !root->is_bare) ||
                           zr_json_gives(given->keys, ZR_MATERIAL_BASE_COLOR_TEXTURE);
    struct zr_face_style faces = zr_face_style_merge(&style->face_style, &given->face_style);
    faces = zr_face_style_merge(&faces, &root->face_style);
    if (faces.alpha_mode == ZR_UNSET && (style->blends || given->blends)) faces.alpha_mode = ZR_ALPHA_BLEND;
    if (faces.double_sided == ZR_UNSET) faces.double_sided = style->is_open;
    struct zr_material material =
        zr_face_style_material(&faces, look, has_color ? given->base_color : none.base_color, smooth);
    zr_resolved_material_put(given, &material);
    if (root->scene->parts.colors == ZR_COLORS_MATERIALS)
        zr_resolved_material_leave_color(has_given ? given : NULL, &material);
    note_oddities(root, style, &faces, &material);
    if (has_given) note_use(&root->materials[style->material], style, &material);
    if (faces.shading != ZR_UNSET && zr_shading_is_linear((enum zr_shading)faces.shading) && !root->linear_key)
        root->linear_key = "shading";
    material.uniform_color = style->is_uniform && zr_shading_is_at(material.shading, ZR_SHADED_NEVER);
    return zr_scene_builder_material(root->builder, &material);
}

uint32_t zr_parsed_make_mesh_material(struct zr_parsed_scene *root, const struct zr_style *style,
                                      const struct zr_mesh *mesh, bool smooth, bool blends)
{
    struct zr_style of = *style;
    of.has_faces = mesh->face_count > 0;
    of.alpha = zr_alpha_range_times(zr_alpha_range_of(mesh->colors, mesh->position_count),
                                    zr_alpha_range_of(mesh->face_colors, mesh->face_count));
    of.blends = blends && of.alpha.least < 1.0f;
    return zr_parsed_make_material(root, &of, mesh->colors || mesh->face_colors, smooth);
}
