#include "input/scene/resolved_material.h"

#include <math.h>

#include "base/trig.h"
#include "input/json/json_value.h"

static zr_vec3 rgb(zr_vec4 color)
{
    return (zr_vec3){color.x, color.y, color.z};
}

/* Source: KHR_materials_ior and KHR_materials_specular. */
static void put_reflectance(const struct zr_parsed_material *given, struct zr_material *material)
{
    const bool has_ior = zr_json_gives(given->keys, ZR_MATERIAL_IOR),
               has_factor = zr_json_gives(given->keys, ZR_MATERIAL_SPECULAR_FACTOR),
               has_color = zr_json_gives(given->keys, ZR_MATERIAL_SPECULAR_COLOR);
    if (!has_ior && !has_factor && !has_color) return;
    const double ior = has_ior ? (double)given->ior : 1.5, root = (ior - 1.0) / (ior + 1.0), of_ior = root * root;
    const double factor = has_factor ? (double)given->specular_factor : 1.0;
    const zr_vec3 color = has_color ? given->specular_color : (zr_vec3){1, 1, 1};
    material->reflectance = (zr_vec3){(float)(factor * fmin(of_ior * (double)color.x, 1.0)),
                                      (float)(factor * fmin(of_ior * (double)color.y, 1.0)),
                                      (float)(factor * fmin(of_ior * (double)color.z, 1.0))};
    material->grazing = (float)factor;
}

/* A given texture replaces the factor of the look or of a finish by 1, unless the factor is given. */
static void put_factors(const struct zr_parsed_material *given, struct zr_material *material)
{
    struct zr_finish *finish = &material->finish;
    const struct {
        int texture, key; /* of enum zr_material_key */
        float *factor;
        zr_vec3 *color; /* instead of a factor */
    } factors[] = {{ZR_MATERIAL_METALLIC_ROUGHNESS_TEXTURE, ZR_MATERIAL_METALLIC, &material->metallic, NULL},
                   {ZR_MATERIAL_METALLIC_ROUGHNESS_TEXTURE, ZR_MATERIAL_ROUGHNESS, &material->roughness, NULL},
                   {ZR_MATERIAL_EMISSIVE_TEXTURE, ZR_MATERIAL_EMISSIVE, NULL, &material->emissive},
                   {ZR_MATERIAL_COAT_TEXTURE, ZR_MATERIAL_COAT, &finish->coat, NULL},
                   {ZR_MATERIAL_COAT_ROUGHNESS_TEXTURE, ZR_MATERIAL_COAT_ROUGHNESS, &finish->coat_roughness, NULL},
                   {ZR_MATERIAL_SHEEN_TEXTURE, ZR_MATERIAL_SHEEN, NULL, &finish->sheen},
                   {ZR_MATERIAL_FILM_TEXTURE, ZR_MATERIAL_FILM, &finish->film, NULL},
                   {ZR_MATERIAL_ANISOTROPY_TEXTURE, ZR_MATERIAL_ANISOTROPY, &finish->anisotropy, NULL},
                   {ZR_MATERIAL_TRANSMISSION_TEXTURE, ZR_MATERIAL_TRANSMISSION, &finish->transmission, NULL},
                   {ZR_MATERIAL_THICKNESS_TEXTURE, ZR_MATERIAL_THICKNESS, &finish->thickness, NULL}};
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        if (!zr_json_gives(given->keys, factors[i].texture) || zr_json_gives(given->keys, factors[i].key)) continue;
        if (factors[i].factor)
            *factors[i].factor = 1.0f;
        else
            *factors[i].color = (zr_vec3){1, 1, 1};
    }
}

/* A film of thickness 0 is none. */
static void put_film(const struct zr_parsed_material *given, struct zr_finish *finish)
{
    const bool has_texture = given->textures[ZR_TEXTURE_FILM_THICKNESS].number > 0;
    if (!zr_json_gives(given->keys, ZR_MATERIAL_FILM_IOR)) finish->film_ior = 1.3f;
    if (!zr_json_gives(given->keys, ZR_MATERIAL_FILM_THICKNESS)) finish->film_nm = 400.0f;
    if (!has_texture)
        finish->film_thinnest = 0.0f;
    else if (!zr_json_gives(given->keys, ZR_MATERIAL_FILM_THINNEST))
        finish->film_thinnest = 100.0f;
    if (finish->film > 0.0f && (finish->film_nm > 0.0f || finish->film_thinnest > 0.0f)) return;
    finish->film = finish->film_ior = finish->film_nm = finish->film_thinnest = 0.0f;
}

static void put_anisotropy(const struct zr_parsed_material *given, struct zr_finish *finish)
{
    double sine, cosine;
    if (!(finish->anisotropy > 0.0f)) return;
    zr_sine_cosine(given->anisotropy_rotation * 57.295779513082321, &sine, &cosine);
    finish->along[0] = (float)cosine;
    finish->along[1] = (float)sine;
}

/* Sets the values of glass; materials without transmission have none. */
static void put_glass(const struct zr_parsed_material *given, struct zr_finish *finish)
{
    finish->ior = zr_json_gives(given->keys, ZR_MATERIAL_IOR) ? given->ior : 1.5f;
    if (!zr_json_gives(given->keys, ZR_MATERIAL_ATTENUATION_COLOR)) finish->attenuation = (zr_vec3){1, 1, 1};
    if (finish->transmission > 0.0f) return;
    finish->ior = finish->thickness = finish->distance = finish->dispersion = 0.0f;
    finish->attenuation = (zr_vec3){0, 0, 0};
}

static void put_textures(const struct zr_parsed_material *given, struct zr_material *material)
{
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        material->textures[slot] = given->textures[slot].number;
    material->is_alpha_only = given->is_alpha_only;
    material->normal_scale = given->textures[ZR_TEXTURE_NORMAL].strength;
    material->coat_normal_scale = given->textures[ZR_TEXTURE_COAT_NORMAL].strength;
    material->occlusion_strength = given->textures[ZR_TEXTURE_OCCLUSION].strength;
}

void zr_resolved_material_put(const struct zr_parsed_material *given, struct zr_material *material)
{
    if (zr_json_gives(given->keys, ZR_MATERIAL_SPECULAR)) material->specular = rgb(given->specular);
    if (zr_json_gives(given->keys, ZR_MATERIAL_SHININESS)) material->shininess = given->shininess;
    if (zr_json_gives(given->keys, ZR_MATERIAL_METALLIC)) material->metallic = given->metallic;
    if (zr_json_gives(given->keys, ZR_MATERIAL_ROUGHNESS)) material->roughness = given->roughness;
    if (zr_json_gives(given->keys, ZR_MATERIAL_EMISSIVE)) material->emissive = given->emissive;
    put_reflectance(given, material);
    material->finish = given->finish;
    put_factors(given, material);
    put_film(given, &material->finish);
    put_anisotropy(given, &material->finish);
    put_glass(given, &material->finish);
    if (zr_json_gives(given->keys, ZR_MATERIAL_COOL)) material->cool = rgb(given->cool);
    put_textures(given, material);
}

void zr_resolved_material_leave_color(const struct zr_parsed_material *given, struct zr_material *material)
{
    const zr_vec3 color = given ? given->linear_color : (zr_vec3){1, 1, 1};
    if (!given || given->has_linear_color)
        material->base_color = (zr_vec4){color.x, color.y, color.z, material->base_color.w};
    material->emissive = (zr_vec3){0, 0, 0};
    material->textures[ZR_TEXTURE_BASE_COLOR] = material->textures[ZR_TEXTURE_EMISSIVE] = 0;
}
