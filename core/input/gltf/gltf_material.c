/* Converts materials of glTF to materials of a scene. Reads a material at its first use by a drawn primitive. */
#include "input/gltf/gltf_extensions.h"

#include <float.h>

#include "base/srgb.h"
#include "input/text/names.h"

/* ---- numbers ---- */

static float clamp(struct zr_gltf *file, const struct zr_json_path *path, double value)
{
    return (float)zr_gltf_clamp(file, path, value, 0.0, 1.0);
}

/* Puts a linear colour, and its encoding as sRGB, the encoding of colours of a scene. */
static void put_color(struct zr_gltf *file, const float linear[4], struct zr_parsed_material *material)
{
    float in[4 + ZR_SRGB_EXCESS] = {linear[0], linear[1], linear[2]}, out[4 + ZR_SRGB_EXCESS];
    zr_srgb_encode_of(zr_team_isa(file->json.team))(in, 4, out);
    material->base_color = (zr_vec4){out[0], out[1], out[2], linear[3]};
    material->linear_color = (zr_vec3){linear[0], linear[1], linear[2]};
    material->has_linear_color = true;
}

/* ---- metallic-roughness ---- */

struct given_pbr {
    double base_color[4], metallic, roughness;
    const char *base_color_texture, *metallic_roughness_texture;
};
enum { BASE_COLOR, METALLIC, ROUGHNESS, BASE_COLOR_TEXTURE, METALLIC_ROUGHNESS_TEXTURE };
#define AT(member) offsetof(struct given_pbr, member)
static const struct zr_json_field pbr_fields[] = {
    [BASE_COLOR] = {.key = "baseColorFactor", .read = zr_gltf_four, .offset = AT(base_color)},
    [METALLIC] =
        {.key = "metallicFactor", .read = zr_json_number, .offset = AT(metallic), .low = -DBL_MAX, .high = DBL_MAX},
    [ROUGHNESS] =
        {.key = "roughnessFactor", .read = zr_json_number, .offset = AT(roughness), .low = -DBL_MAX, .high = DBL_MAX},
    [BASE_COLOR_TEXTURE] = {.key = "baseColorTexture", .read = zr_json_value_start, .offset = AT(base_color_texture)},
    [METALLIC_ROUGHNESS_TEXTURE] = {.key = "metallicRoughnessTexture",
                                    .read = zr_json_value_start,
                                    .offset = AT(metallic_roughness_texture)},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object pbr_object = ZR_JSON_OBJECT_OF("pbrMetallicRoughness", pbr_fields);

static void read_texture(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                         enum zr_texture_slot slot, struct zr_parsed_material *out)
{
    if (place) zr_gltf_read_texture(file, place, ZR_JSON_KEY(path, zr_texture_keys[slot]), slot, &out->textures[slot]);
}

static void read_pbr(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                     struct zr_parsed_material *out)
{
    struct given_pbr given = {.base_color = {1, 1, 1, 1}, .metallic = 1, .roughness = 1};
    float color[4];
    if (place) {
        zr_gltf_fields_at(file, place, path, &pbr_object, &given);
    }
    for (int k = 0; k < 4; k++)
        color[k] = clamp(file, ZR_JSON_KEY(path, pbr_fields[BASE_COLOR].key), given.base_color[k]);
    put_color(file, color, out);
    out->metallic = clamp(file, ZR_JSON_KEY(path, pbr_fields[METALLIC].key), given.metallic);
    out->roughness = clamp(file, ZR_JSON_KEY(path, pbr_fields[ROUGHNESS].key), given.roughness);
    read_texture(file, path, given.base_color_texture, ZR_TEXTURE_BASE_COLOR, out);
    read_texture(file, path, given.metallic_roughness_texture, ZR_TEXTURE_METALLIC_ROUGHNESS, out);
}

/* ---- extensions ---- */

struct given_extensions {
    const char *unlit, *strength, *ior, *specular, *glossiness, *finish[ZR_GLTF_FINISHES]; /* JSON text */
};
enum { UNLIT, STRENGTH, IOR, SPECULAR, GLOSSINESS };
#define AT(member) offsetof(struct given_extensions, member)
static const struct zr_json_field extension_fields[] = {
    [UNLIT] = {.key = "KHR_materials_unlit", .read = zr_json_value_start, .offset = AT(unlit)},
    [STRENGTH] = {.key = "KHR_materials_emissive_strength", .read = zr_json_value_start, .offset = AT(strength)},
    [IOR] = {.key = "KHR_materials_ior", .read = zr_json_value_start, .offset = AT(ior)},
    [SPECULAR] = {.key = "KHR_materials_specular", .read = zr_json_value_start, .offset = AT(specular)},
    [GLOSSINESS] = {.key = "KHR_materials_pbrSpecularGlossiness",
                    .read = zr_json_value_start,
                    .offset = AT(glossiness)},
    {.key = "KHR_materials_clearcoat", .read = zr_json_value_start, .offset = AT(finish[ZR_GLTF_COAT])},
    {.key = "KHR_materials_sheen", .read = zr_json_value_start, .offset = AT(finish[ZR_GLTF_SHEEN])},
    {.key = "KHR_materials_iridescence", .read = zr_json_value_start, .offset = AT(finish[ZR_GLTF_FILM])},
    {.key = "KHR_materials_anisotropy", .read = zr_json_value_start, .offset = AT(finish[ZR_GLTF_ANISOTROPY])},
    {.key = "KHR_materials_transmission", .read = zr_json_value_start, .offset = AT(finish[ZR_GLTF_TRANSMISSION])},
    {.key = "KHR_materials_volume", .read = zr_json_value_start, .offset = AT(finish[ZR_GLTF_VOLUME])},
    {.key = "KHR_materials_dispersion", .read = zr_json_value_start, .offset = AT(finish[ZR_GLTF_DISPERSION])}};
#undef AT
static const struct zr_json_object extension_object = {ZR_JSON_FIELDS("extensions", extension_fields), .is_open = true};

#define EMISSIVE_MAX 1e6

struct given_strength {
    double strength;
};
static const struct zr_json_field strength_fields[] = {{.key = "emissiveStrength",
                                                        .read = zr_json_number,
                                                        .offset = offsetof(struct given_strength, strength),
                                                        .high = EMISSIVE_MAX},
                                                       ZR_GLTF_COMMON};
static const struct zr_json_object strength_object =
    ZR_JSON_OBJECT_OF("KHR_materials_emissive_strength", strength_fields);

/* Replaces the values of metallic-roughness. */
static void read_glossy(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                        struct zr_parsed_material *out)
{
    struct zr_gltf_glossiness found;
    zr_gltf_read_glossiness(file, path, place, &found);
    file->has_fallbacks = true;
    put_color(file, found.color, out);
    out->metallic = found.metallic;
    out->roughness = found.roughness;
    out->textures[ZR_TEXTURE_BASE_COLOR] = found.color_texture;
    out->textures[ZR_TEXTURE_METALLIC_ROUGHNESS] = found.rough_texture;
}

/* Sets *strength to the factor of the emitted light. True if an extension replaces metallic-roughness. */
static bool read_extensions(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                            struct zr_parsed_material *out, double *strength)
{
    struct given_extensions given = {.unlit = NULL};
    struct given_strength emissive = {1};
    zr_gltf_fields_at(file, place, path, &extension_object, &given);
    if (given.unlit)
        out->face_style.shading = ZR_SHADING_UNLIT;
    else if (given.ior || given.specular)
        zr_gltf_read_reflectance(file, path, given.ior, given.specular, out);
    if (!given.unlit) zr_gltf_read_finish(file, path, given.finish, out);
    if (given.glossiness) read_glossy(file, ZR_JSON_KEY(path, extension_fields[GLOSSINESS].key), given.glossiness, out);
    if (!given.strength) return given.glossiness != NULL;
    zr_gltf_fields_at(file, given.strength, ZR_JSON_KEY(path, extension_fields[STRENGTH].key), &strength_object,
                      &emissive);
    *strength = emissive.strength;
    return given.glossiness != NULL;
}

/* ---- materials ---- */

struct given_material {
    const char *name, *pbr, *normal, *occlusion, *emissive, *extensions; /* all but the name are places */
    double emitted[3];
    int alpha_mode, is_double_sided;
    double alpha_cutoff;
};
enum { NAME, PBR, NORMAL, OCCLUSION, EMISSIVE, EMITTED, ALPHA_MODE, ALPHA_CUTOFF, DOUBLE_SIDED, EXTENSIONS };
#define AT(member) offsetof(struct given_material, member)
static const struct zr_json_field fields[] = {
    [NAME] = {.key = "name", .read = zr_json_string, .offset = AT(name)},
    [PBR] = {.key = "pbrMetallicRoughness", .read = zr_json_value_start, .offset = AT(pbr)},
    [NORMAL] = {.key = "normalTexture", .read = zr_json_value_start, .offset = AT(normal)},
    [OCCLUSION] = {.key = "occlusionTexture", .read = zr_json_value_start, .offset = AT(occlusion)},
    [EMISSIVE] = {.key = "emissiveTexture", .read = zr_json_value_start, .offset = AT(emissive)},
    [EMITTED] = {.key = "emissiveFactor", .read = zr_gltf_three, .offset = AT(emitted)},
    [ALPHA_MODE] = {"alphaMode", zr_json_choice, AT(alpha_mode), .words = &zr_alpha_mode_names},
    [ALPHA_CUTOFF] =
        {.key = "alphaCutoff", .read = zr_json_number, .offset = AT(alpha_cutoff), .low = 0, .high = DBL_MAX},
    [DOUBLE_SIDED] = {.key = "doubleSided", .read = zr_json_flag, .offset = AT(is_double_sided)},
    [EXTENSIONS] = {.key = "extensions", .read = zr_json_value_start, .offset = AT(extensions)},
    {.key = "extras", .read = zr_gltf_ignore}};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("material", fields);

static void put_emission(struct zr_gltf *file, const struct zr_json_path *path, const struct given_material *given,
                         double strength, struct zr_parsed_material *out)
{
    const struct zr_json_path *at = ZR_JSON_KEY(path, fields[EMITTED].key);
    float v[3];
    bool is_dark = true;
    for (int k = 0; k < 3; k++) {
        v[k] = (float)((double)clamp(file, at, given->emitted[k]) * strength);
        is_dark = is_dark && v[k] == 0.0f;
    }
    out->emissive = (zr_vec3){v[0], v[1], v[2]};
    if (!is_dark) read_texture(file, path, given->emissive, ZR_TEXTURE_EMISSIVE, out);
}

static bool read_material(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                          struct zr_parsed_material *out)
{
    struct given_material given = {.name = "", .alpha_cutoff = 0.5};
    const size_t faults = file->json.error->count;
    double strength = 1;
    file->sets = (struct zr_gltf_sets){{ZR_GLTF_NONE, ZR_GLTF_NONE}};
    if (!zr_gltf_fields_at(file, place, path, &object, &given)) return false;
    out->name = given.name;
    out->keys = UINT64_C(1) << ZR_MATERIAL_BASE_COLOR | UINT64_C(1) << ZR_MATERIAL_METALLIC |
                UINT64_C(1) << ZR_MATERIAL_ROUGHNESS | UINT64_C(1) << ZR_MATERIAL_EMISSIVE;
    out->face_style = zr_face_style_unset;
    out->face_style.double_sided = given.is_double_sided;
    out->face_style.alpha_mode = given.alpha_mode;
    if (given.alpha_mode == ZR_ALPHA_MASK)
        out->face_style.alpha_cutoff = given.alpha_cutoff < 1.0 ? (float)given.alpha_cutoff : 1.0f;
    const bool is_glossy = given.extensions && read_extensions(file, ZR_JSON_KEY(path, fields[EXTENSIONS].key),
                                                               given.extensions, out, &strength);
    if (!is_glossy) read_pbr(file, ZR_JSON_KEY(path, fields[PBR].key), given.pbr, out);
    read_texture(file, path, given.normal, ZR_TEXTURE_NORMAL, out);
    read_texture(file, path, given.occlusion, ZR_TEXTURE_OCCLUSION, out);
    put_emission(file, path, &given, strength, out);
    return file->json.error->count == faults;
}

static void note_place(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    zr_json_value_start(json, path, &file->material_places[number]);
}

bool zr_gltf_read_materials(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    const uint32_t count = file->counts[ZR_GLTF_MATERIALS];
    file->made->material_count = count;
    file->made->materials = zr_arena_zero(arena, count, sizeof *file->made->materials);
    file->material_places = zr_arena_zero(arena, count, sizeof *file->material_places);
    file->material_sets = zr_arena_zero(arena, count, sizeof *file->material_sets);
    return zr_arena_ok(arena) && zr_gltf_read_list(file, ZR_GLTF_MATERIALS, note_place);
}

const struct zr_parsed_material *zr_gltf_find_material(struct zr_gltf *file, const struct zr_json_path *path,
                                                       uint32_t number)
{
    if (!zr_gltf_check_index(file, path, number, ZR_GLTF_MATERIALS)) return NULL;
    struct zr_parsed_material *material = &file->made->materials[number];
    const char *place = file->material_places[number];
    if (place && !read_material(file, place, ZR_GLTF_ITEM(ZR_GLTF_MATERIALS, number), material)) return NULL;
    if (place) file->material_sets[number] = file->sets;
    file->material_places[number] = NULL;
    return material;
}

void zr_gltf_list_images_of(struct zr_gltf *file, uint32_t number)
{
    struct zr_parsed_material unused = {.name = NULL};
    if (number < file->counts[ZR_GLTF_MATERIALS] && file->material_places[number])
        read_material(file, file->material_places[number], ZR_GLTF_ITEM(ZR_GLTF_MATERIALS, number), &unused);
}

uint32_t zr_gltf_texcoords_of(const struct zr_parsed_material *material)
{
    uint32_t sets = 0;
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        if (material->textures[slot].number > 0) sets |= 1u << material->textures[slot].texcoord;
    return sets;
}

uint32_t zr_gltf_set_of(const struct zr_gltf *file, uint32_t material, uint32_t place)
{
    const uint32_t set = material == ZR_GLTF_NONE ? ZR_GLTF_NONE : file->material_sets[material].of[place];
    return set == ZR_GLTF_NONE ? place : set;
}
