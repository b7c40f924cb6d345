/* Reads the extensions of glTF that set the reflectance of non-metals. */
#include "input/gltf/gltf_extensions.h"

#include <float.h>
#include <string.h>

#include "scene/texture.h"

/* ---- KHR_materials_ior and KHR_materials_specular ---- */

struct given_reflectance {
    double ior, factor, color[3];
};

#define NUMBER(name, at)                                                                                               \
    {                                                                                                                  \
        .key = (name), .read = zr_json_number, .offset = (at), .low = -DBL_MAX, .high = DBL_MAX                        \
    }
#define AT(member) offsetof(struct given_reflectance, member)
static const struct zr_json_field ior_fields[] = {NUMBER("ior", AT(ior)), ZR_GLTF_COMMON};
static const struct zr_json_field specular_fields[] = {
    NUMBER("specularFactor", AT(factor)),
    {.key = "specularColorFactor", .read = zr_gltf_three, .offset = AT(color)},
    {.key = "specularTexture", .read = zr_gltf_ignore},
    {.key = "specularColorTexture", .read = zr_gltf_ignore},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object ior_object = ZR_JSON_OBJECT_OF("KHR_materials_ior", ior_fields);
static const struct zr_json_object specular_object = ZR_JSON_OBJECT_OF("KHR_materials_specular", specular_fields);
enum { TEXTURES = 1 << 2 | 1 << 3 };

/* KHR_materials_ior defines that an index of 0 reflects all light. */
static void read_ior(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                     struct zr_parsed_material *out)
{
    struct given_reflectance given = {.ior = 1.5};
    zr_gltf_fields_at(file, place, path, &ior_object, &given);
    out->ior = given.ior == 0.0 ? FLT_MAX
                                : (float)zr_gltf_clamp(file, ZR_JSON_KEY(path, "ior"), given.ior, 1.0, (double)FLT_MAX);
    out->keys |= UINT64_C(1) << ZR_MATERIAL_IOR;
}

void zr_gltf_read_reflectance(struct zr_gltf *file, const struct zr_json_path *path, const char *ior,
                              const char *specular, struct zr_parsed_material *out)
{
    struct given_reflectance given = {1.5, 1, {1, 1, 1}};
    if (ior) read_ior(file, ZR_JSON_KEY(path, ior_object.name), ior, out);
    if (!specular) return;
    const struct zr_json_path *at = ZR_JSON_KEY(path, specular_object.name);
    zr_gltf_fields_at(file, specular, at, &specular_object, &given);
    if (file->given & TEXTURES) zr_gltf_note(&file->specular_textures, at);
    out->specular_factor = (float)zr_gltf_clamp(file, ZR_JSON_KEY(at, "specularFactor"), given.factor, 0.0, 1.0);
    for (int k = 0; k < 3; k++)
        given.color[k] =
            zr_gltf_clamp(file, ZR_JSON_KEY(at, "specularColorFactor"), given.color[k], 0.0, (double)FLT_MAX);
    out->specular_color = (zr_vec3){(float)given.color[0], (float)given.color[1], (float)given.color[2]};
    out->keys |= UINT64_C(1) << ZR_MATERIAL_SPECULAR_FACTOR | UINT64_C(1) << ZR_MATERIAL_SPECULAR_COLOR;
}

/* ---- KHR_materials_pbrSpecularGlossiness ---- */

struct given_glossiness {
    double diffuse[4], specular[3], glossiness;
    const char *diffuse_texture, *texture; /* JSON text */
};
#define AT(member) offsetof(struct given_glossiness, member)
static const struct zr_json_field glossiness_fields[] = {
    {.key = "diffuseFactor", .read = zr_gltf_four, .offset = AT(diffuse)},
    {.key = "specularFactor", .read = zr_gltf_three, .offset = AT(specular)},
    NUMBER("glossinessFactor", AT(glossiness)),
    {.key = "diffuseTexture", .read = zr_json_value_start, .offset = AT(diffuse_texture)},
    {.key = "specularGlossinessTexture", .read = zr_json_value_start, .offset = AT(texture)},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object glossiness_object =
    ZR_JSON_OBJECT_OF("KHR_materials_pbrSpecularGlossiness", glossiness_fields);

/* True if both textures have the same coordinates, transform and wrapping, so their texels form pairs. */
static bool is_alike(const struct zr_texture *a, const struct zr_texture *b)
{
    return a->texcoord == b->texcoord && a->wrap_s == b->wrap_s && a->wrap_t == b->wrap_t &&
           memcmp(a->rows, b->rows, sizeof a->rows) == 0;
}

/* Makes the textures of colour and roughness. `diffuse` may be NULL. False if the given textures cannot be converted in
 * pairs, or beyond a limit. */
static bool bake(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_gloss *factors,
                 const struct zr_texture *diffuse, const struct zr_texture *specular, struct zr_gltf_glossiness *out)
{
    struct zr_texture made = diffuse ? *diffuse : *specular;
    if (diffuse && !is_alike(diffuse, specular)) return false;
    const struct zr_gltf_baked *baked =
        zr_gltf_bake_glossiness(file, factors, diffuse ? &diffuse->image : NULL, specular->image);
    if (!baked) return false;
    made.image = baked->color;
    zr_gltf_add_texture(file, path, &made, &out->color_texture);
    made.image = baked->rough;
    made.is_color = false;
    zr_gltf_add_texture(file, path, &made, &out->rough_texture);
    out->color[0] = out->color[1] = out->color[2] = out->metallic = out->roughness = 1.0f;
    return true;
}

/* Sets colour, metallic and roughness from the factors. */
static void use_factors(const struct zr_gltf_gloss *factors, struct zr_gltf_glossiness *out)
{
    zr_gltf_convert_glossiness(factors->diffuse, factors->specular, out);
    out->roughness = (float)(1.0 - factors->glossiness);
}

static void read_textures(struct zr_gltf *file, const struct zr_json_path *path, const struct given_glossiness *given,
                          struct zr_gltf_gloss *factors, struct zr_gltf_glossiness *out)
{
    const struct zr_json_path *of_diffuse = ZR_JSON_KEY(path, "diffuseTexture");
    struct zr_texture diffuse, specular;
    const bool has_diffuse =
                   given->diffuse_texture && zr_gltf_find_texture(file, given->diffuse_texture, of_diffuse,
                                                                  ZR_TEXTURE_BASE_COLOR, &out->color_texture, &diffuse),
               has_specular = given->texture &&
                              zr_gltf_find_texture(file, given->texture, ZR_JSON_KEY(path, "specularGlossinessTexture"),
                                                   ZR_TEXTURE_BASE_COLOR, &out->rough_texture, &specular);
    if (has_specular && !has_diffuse) out->color_texture = out->rough_texture;
    if (has_specular && bake(file, path, factors, has_diffuse ? &diffuse : NULL, &specular, out)) return;
    if (given->texture) { /* without the texture, which the factors scale: a non-metal with half of the glossiness */
        zr_gltf_note(&file->gloss_textures, path);
        for (int k = 0; k < 3; k++)
            factors->specular[k] = ZR_GLTF_PLASTIC;
        factors->glossiness *= 0.5;
    }
    use_factors(factors, out);
    if (has_diffuse) zr_gltf_add_texture(file, of_diffuse, &diffuse, &out->color_texture);
}

void zr_gltf_read_glossiness(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                             struct zr_gltf_glossiness *out)
{
    struct given_glossiness given = {{1, 1, 1, 1}, {1, 1, 1}, 1, NULL, NULL};
    struct zr_gltf_gloss factors;
    *out = (struct zr_gltf_glossiness){.roughness = 1};
    zr_gltf_fields_at(file, place, path, &glossiness_object, &given);
    for (int k = 0; k < 4; k++)
        given.diffuse[k] = zr_gltf_clamp(file, ZR_JSON_KEY(path, "diffuseFactor"), given.diffuse[k], 0.0, 1.0);
    for (int k = 0; k < 3; k++) {
        factors.diffuse[k] = given.diffuse[k];
        factors.specular[k] = zr_gltf_clamp(file, ZR_JSON_KEY(path, "specularFactor"), given.specular[k], 0.0, 1.0);
    }
    factors.glossiness = zr_gltf_clamp(file, ZR_JSON_KEY(path, "glossinessFactor"), given.glossiness, 0.0, 1.0);
    out->color[3] = (float)given.diffuse[3];
    if (given.texture || given.diffuse_texture)
        read_textures(file, path, &given, &factors, out);
    else
        use_factors(&factors, out);
}
