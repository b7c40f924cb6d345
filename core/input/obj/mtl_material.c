/* Converts a material of MTL to a material of a scene. The rules are in mtl.h. */
#include <math.h>

#include "input/obj/mtl_file.h"
#include "scene/texture.h"

#define SHININESS_MOST   1000.0f
#define SPECULAR_LEAST   0.1f
#define TOLERANCE_OF_ONE 1e-3f /* for d + Tr */

/* ---- textures ---- */

/* Sets a texture to an image, placed by the options of `map`. In MTL, v' = s v + o, and v counts from the bottom. In a
 * scene, v counts from the top, so this becomes s v + (1 - s - o). */
static void put_texture(struct zr_mtl *mtl, const struct zr_mtl_given_map *map, enum zr_texture_slot slot,
                        uint32_t image, struct zr_parsed_material *out)
{
    const enum zr_wrap wrap = map->is_clamped ? ZR_WRAP_CLAMP : ZR_WRAP_REPEAT;
    struct zr_texture texture = {.image = image,
                                 .wrap_s = wrap,
                                 .wrap_t = wrap,
                                 .magnify = ZR_FILTER_LINEAR,
                                 .minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR,
                                 .is_color = slot == ZR_TEXTURE_BASE_COLOR || slot == ZR_TEXTURE_EMISSIVE};
    struct zr_parsed_texture given = {.is_given = true,
                                      .scale = {map->scale[0], map->scale[1]},
                                      .offset = {map->offset[0], 1.0f - map->scale[1] - map->offset[1]},
                                      .strength = map->strength};
    if (mtl->builder->scene->texture_count >= ZR_TEXTURES_MAX) {
        zr_mtl_note(mtl, ZR_MTL_NOTE_BAD_IMAGE, &map->whole);
        return;
    }
    zr_parsed_put_transform(&given, &texture);
    given.number = 1 + zr_scene_builder_texture(mtl->builder, &texture);
    out->textures[slot] = given;
}

/* True if both maps have the same options.
 * Otherwise counts the second one for a warning, since one image has only one transform. */
static bool is_alike(struct zr_mtl *mtl, const struct zr_mtl_given_map *a, const struct zr_mtl_given_map *b)
{
    bool same = a->is_clamped == b->is_clamped;
    for (int k = 0; k < 2; k++)
        same = same && a->scale[k] == b->scale[k] && a->offset[k] == b->offset[k];
    if (!same) zr_mtl_note(mtl, ZR_MTL_NOTE_ALPHA_PLACE, &b->whole);
    return same;
}

static struct zr_mtl_channel channel_of(uint32_t image, uint32_t channel)
{
    return (struct zr_mtl_channel){1 + image, channel};
}

/* The alpha of the base colour; 1 if it is 0. */
static float given_alpha(const struct zr_mtl_values *given)
{
    const float alpha = given->has_alpha ? given->alpha : given->has_transparency ? 1.0f - given->transparency : 1.0f;
    return alpha > 0.0f ? alpha : 1.0f;
}

/* Contents of the texture of map_Kd and map_d. */
struct base_map {
    bool has_color, is_see_through; /* is_see_through: its alpha is used */
};

/* Makes the texture of map_Kd and map_d. */
static struct base_map put_base(struct zr_mtl *mtl, const struct zr_mtl_values *given, struct zr_parsed_material *out)
{
    const struct zr_mtl_given_map *color = &given->maps[ZR_MTL_MAP_COLOR], *alpha = &given->maps[ZR_MTL_MAP_ALPHA];
    struct zr_mtl_channel channels[4] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    uint32_t of_color = 0, of_alpha = 0, made;
    const bool has_color = zr_mtl_find_image(mtl, color, &of_color);
    bool has_alpha = zr_mtl_find_image(mtl, alpha, &of_alpha);
    if (has_color && has_alpha) has_alpha = is_alike(mtl, color, alpha);
    const struct base_map made_of = {has_color, has_alpha};
    if (mtl->status != ZR_OK || !(has_color || has_alpha)) return (struct base_map){false, false};
    if (!has_alpha) {
        if (given_alpha(given) >= 1.0f && !zr_image_list_is_opaque(&mtl->decoded, of_color))
            zr_mtl_note(mtl, ZR_MTL_NOTE_OPAQUE, &color->whole);
        put_texture(mtl, color, ZR_TEXTURE_BASE_COLOR, of_color, out);
        return made_of;
    }
    const bool is_channel = !zr_image_list_is_opaque(&mtl->decoded, of_alpha);
    if (is_channel && has_color && of_color == of_alpha) {
        put_texture(mtl, color, ZR_TEXTURE_BASE_COLOR, of_color, out);
        return made_of;
    }
    for (uint32_t k = 0; k < 3 && has_color; k++)
        channels[k] = channel_of(of_color, k);
    channels[3] = channel_of(of_alpha, is_channel ? 3 : 0);
    if (zr_mtl_make_image(mtl, &alpha->whole, channels, &made))
        put_texture(mtl, has_color ? color : alpha, ZR_TEXTURE_BASE_COLOR, made, out);
    return made_of;
}

/* Makes the texture of map_Pr (green) and map_Pm (blue). */
static void put_metallic_roughness(struct zr_mtl *mtl, const struct zr_mtl_values *given,
                                   struct zr_parsed_material *out)
{
    const struct zr_mtl_given_map *rough = &given->maps[ZR_MTL_MAP_ROUGHNESS],
                                  *metal = &given->maps[ZR_MTL_MAP_METALLIC];
    struct zr_mtl_channel channels[4] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    uint32_t of_rough = 0, of_metal = 0, made;
    const bool is_rough = zr_mtl_find_image(mtl, rough, &of_rough);
    bool is_metal = zr_mtl_find_image(mtl, metal, &of_metal);
    if (is_rough && is_metal) is_metal = is_alike(mtl, rough, metal);
    if (mtl->status != ZR_OK || !(is_rough || is_metal)) return;
    if (is_rough) {
        channels[1] = channel_of(of_rough, 0);
        out->keys |= UINT64_C(1) << ZR_MATERIAL_ROUGHNESS;
        out->roughness = given->has_roughness && given->roughness > 0.0f ? given->roughness : 1.0f;
    }
    if (is_metal) {
        channels[2] = channel_of(of_metal, 0);
        out->keys |= UINT64_C(1) << ZR_MATERIAL_METALLIC;
        out->metallic = given->has_metallic && given->metallic > 0.0f ? given->metallic : 1.0f;
    }
    if (zr_mtl_make_image(mtl, is_rough ? &rough->whole : &metal->whole, channels, &made))
        put_texture(mtl, is_rough ? rough : metal, ZR_TEXTURE_METALLIC_ROUGHNESS, made, out);
}

static void put_normals(struct zr_mtl *mtl, const struct zr_mtl_values *given, struct zr_parsed_material *out)
{
    const struct zr_mtl_given_map *normal = &given->maps[ZR_MTL_MAP_NORMAL], *bump = &given->maps[ZR_MTL_MAP_BUMP];
    uint32_t image;
    if (zr_mtl_find_image(mtl, normal, &image)) {
        put_texture(mtl, normal, ZR_TEXTURE_NORMAL, image, out);
        return;
    }
    if (normal->is_given || !zr_mtl_find_image(mtl, bump, &image)) return;
    if (zr_mtl_is_grey(mtl, image))
        zr_mtl_note(mtl, ZR_MTL_NOTE_HEIGHTS, &bump->whole);
    else
        put_texture(mtl, bump, ZR_TEXTURE_NORMAL, image, out);
}

/* ---- values ---- */

static float linear_of(float value)
{
    return value > 1.0f ? value : zr_light_color((zr_vec3){-value, 0, 0}, true).x;
}

/* Ke is sRGB-encoded up to 1. A map_Ke without a Ke has the factor 1. */
static void put_emission(struct zr_mtl *mtl, const struct zr_mtl_values *given, struct zr_parsed_material *out)
{
    const float *v = given->emission;
    uint32_t image;
    const bool is_dark = v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f;
    const bool has_map = zr_mtl_find_image(mtl, &given->maps[ZR_MTL_MAP_EMISSION], &image);
    out->keys |= UINT64_C(1) << ZR_MATERIAL_EMISSIVE;
    out->emissive = is_dark && has_map ? (zr_vec3){1, 1, 1}
                                       : (zr_vec3){linear_of(fminf(v[0], 1e6f)), linear_of(fminf(v[1], 1e6f)),
                                                   linear_of(fminf(v[2], 1e6f))};
    if (has_map) put_texture(mtl, &given->maps[ZR_MTL_MAP_EMISSION], ZR_TEXTURE_EMISSIVE, image, out);
}

static float alpha_of(struct zr_mtl *mtl, const struct zr_mtl_values *given)
{
    if (given->has_alpha && given->has_transparency &&
        fabsf(given->alpha + given->transparency - 1.0f) > TOLERANCE_OF_ONE)
        zr_mtl_note(mtl, ZR_MTL_NOTE_DISAGREE, &given->alpha_line);
    if (given->has_alpha ? given->alpha <= 0.0f : given->has_transparency && given->transparency >= 1.0f)
        zr_mtl_note(mtl, ZR_MTL_NOTE_UNSEEN, &given->alpha_line);
    return given_alpha(given);
}

static void put_color(struct zr_mtl *mtl, const struct zr_mtl_values *given, const struct base_map *map,
                      struct zr_parsed_material *out)
{
    const float *v = given->diffuse;
    const float alpha = alpha_of(mtl, given);
    const bool has_texture = out->textures[ZR_TEXTURE_BASE_COLOR].number > 0;
    const struct zr_mtl_given_map *color = &given->maps[ZR_MTL_MAP_COLOR];
    const bool is_black = given->has_diffuse && v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f;
    const bool has_diffuse = given->has_diffuse && !(is_black && color->is_given);
    if (has_diffuse != given->has_diffuse)
        zr_mtl_note(mtl, map->has_color ? ZR_MTL_NOTE_BLACK : ZR_MTL_NOTE_BLACK_ALONE, &color->whole);
    out->base_color = has_diffuse ? (zr_vec4){v[0], v[1], v[2], alpha} : (zr_vec4){1, 1, 1, alpha};
    if (has_diffuse || has_texture || alpha < 1.0f) out->keys |= UINT64_C(1) << ZR_MATERIAL_BASE_COLOR;
    out->blends = map->is_see_through || alpha < 1.0f;
    if (!out->blends) out->face_style.alpha_mode = ZR_ALPHA_OPAQUE;
}

/* Source: obj2gltf, convertTraditionalToMetallicRoughness. */
static float roughness_of(const struct zr_mtl_values *given)
{
    const float *s = given->specular;
    const float luminance = 0.2125f * s[0] + 0.7154f * s[1] + 0.0721f * s[2];
    const float rough = 1.0f - fminf(given->shininess, SHININESS_MOST) / SHININESS_MOST;
    return luminance < SPECULAR_LEAST ? rough * (1.0f - luminance) : rough;
}

void zr_mtl_convert(struct zr_mtl *mtl, const struct zr_mtl_values *given, struct zr_parsed_material *out)
{
    if (given->has_roughness || given->has_shininess) {
        out->keys |= UINT64_C(1) << ZR_MATERIAL_ROUGHNESS;
        out->roughness = given->has_roughness ? given->roughness : roughness_of(given);
    }
    if (given->has_metallic || given->has_shininess || given->has_specular) {
        out->keys |= UINT64_C(1) << ZR_MATERIAL_METALLIC;
        out->metallic = given->has_metallic ? given->metallic : 0.0f;
    }
    const struct base_map map = put_base(mtl, given, out);
    put_color(mtl, given, &map, out);
    put_metallic_roughness(mtl, given, out);
    put_normals(mtl, given, out);
    put_emission(mtl, given, out);
}
