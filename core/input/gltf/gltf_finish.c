/* Reads the extensions of glTF that set finishes of surfaces (struct zr_finish). */
#include <float.h>

#include "input/gltf/gltf_extensions.h"

#define NUMBER(name, at)                                                                                               \
    {                                                                                                                  \
        .key = (name), .read = zr_json_number, .offset = (at), .low = -DBL_MAX, .high = DBL_MAX                        \
    }
#define TEXT(name, at)                                                                                                 \
    {                                                                                                                  \
        .key = (name), .read = zr_json_value_start, .offset = (at)                                                     \
    }

static float clamp_key(struct zr_gltf *file, const struct zr_json_path *path, const char *key, double value)
{
    return (float)zr_gltf_clamp(file, ZR_JSON_KEY(path, key), value, 0.0, 1.0);
}

static zr_vec3 clamp_color(struct zr_gltf *file, const struct zr_json_path *path, const char *key,
                           const double color[3])
{
    return (zr_vec3){clamp_key(file, path, key, color[0]), clamp_key(file, path, key, color[1]),
                     clamp_key(file, path, key, color[2])};
}

/* Reads a texture of the extension at `path`. text: NULL if the file gives none. */
static void read_texture(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                         enum zr_texture_slot slot, struct zr_parsed_material *out)
{
    if (text) zr_gltf_read_texture(file, text, ZR_JSON_KEY(path, zr_texture_keys[slot]), slot, &out->textures[slot]);
}

static void note_undrawn(struct zr_gltf *file, const struct zr_json_path *path, const char *text, const char *key)
{
    if (text) zr_gltf_note(&file->undrawn_textures, ZR_JSON_KEY(path, key));
}

/* ---- KHR_materials_clearcoat ---- */

struct given_coat {
    double factor, roughness;
    const char *texture, *roughness_texture, *normal_texture; /* JSON text */
};
#define AT(member) offsetof(struct given_coat, member)
static const struct zr_json_field coat_fields[] = {NUMBER("clearcoatFactor", AT(factor)),
                                                   NUMBER("clearcoatRoughnessFactor", AT(roughness)),
                                                   TEXT("clearcoatTexture", AT(texture)),
                                                   TEXT("clearcoatRoughnessTexture", AT(roughness_texture)),
                                                   TEXT("clearcoatNormalTexture", AT(normal_texture)),
                                                   ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object coat_object = ZR_JSON_OBJECT_OF("KHR_materials_clearcoat", coat_fields);

static void read_coat(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                      struct zr_parsed_material *out)
{
    struct given_coat given = {0, 0, NULL, NULL, NULL};
    zr_gltf_fields_at(file, text, path, &coat_object, &given);
    out->finish.coat = clamp_key(file, path, "clearcoatFactor", given.factor);
    out->finish.coat_roughness = clamp_key(file, path, "clearcoatRoughnessFactor", given.roughness);
    out->keys |= UINT64_C(1) << ZR_MATERIAL_COAT | UINT64_C(1) << ZR_MATERIAL_COAT_ROUGHNESS;
    if (out->finish.coat == 0.0f) return;
    read_texture(file, path, given.texture, ZR_TEXTURE_COAT, out);
    if (out->finish.coat_roughness > 0.0f)
        read_texture(file, path, given.roughness_texture, ZR_TEXTURE_COAT_ROUGHNESS, out);
    read_texture(file, path, given.normal_texture, ZR_TEXTURE_COAT_NORMAL, out);
}

/* ---- KHR_materials_sheen ---- */

struct given_sheen {
    double color[3], roughness;
    const char *color_texture, *roughness_texture; /* JSON text */
};
#define AT(member) offsetof(struct given_sheen, member)
static const struct zr_json_field sheen_fields[] = {
    {.key = "sheenColorFactor", .read = zr_gltf_three, .offset = AT(color)},
    NUMBER("sheenRoughnessFactor", AT(roughness)),
    TEXT("sheenColorTexture", AT(color_texture)),
    TEXT("sheenRoughnessTexture", AT(roughness_texture)),
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object sheen_object = ZR_JSON_OBJECT_OF("KHR_materials_sheen", sheen_fields);

static void read_sheen(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                       struct zr_parsed_material *out)
{
    struct given_sheen given = {{0, 0, 0}, 0, NULL, NULL};
    zr_gltf_fields_at(file, text, path, &sheen_object, &given);
    out->finish.sheen = clamp_color(file, path, "sheenColorFactor", given.color);
    out->finish.sheen_roughness = clamp_key(file, path, "sheenRoughnessFactor", given.roughness);
    out->keys |= UINT64_C(1) << ZR_MATERIAL_SHEEN | UINT64_C(1) << ZR_MATERIAL_SHEEN_ROUGHNESS;
    if (!zr_finish_has_sheen(&out->finish)) return;
    read_texture(file, path, given.color_texture, ZR_TEXTURE_SHEEN, out);
    note_undrawn(file, path, given.roughness_texture, "sheenRoughnessTexture");
}

/* ---- KHR_materials_iridescence ---- */

struct given_film {
    double factor, ior, thinnest, thickest;
    const char *texture, *thickness_texture; /* JSON text */
};
#define AT(member) offsetof(struct given_film, member)
static const struct zr_json_field film_fields[] = {NUMBER("iridescenceFactor", AT(factor)),
                                                   NUMBER("iridescenceIor", AT(ior)),
                                                   NUMBER("iridescenceThicknessMinimum", AT(thinnest)),
                                                   NUMBER("iridescenceThicknessMaximum", AT(thickest)),
                                                   TEXT("iridescenceTexture", AT(texture)),
                                                   TEXT("iridescenceThicknessTexture", AT(thickness_texture)),
                                                   ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object film_object = ZR_JSON_OBJECT_OF("KHR_materials_iridescence", film_fields);

#define FILM_IOR_MAX 100.0

/* Without its texture, a film has the greatest thickness. */
static void read_film(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                      struct zr_parsed_material *out)
{
    struct given_film given = {0, 1.3, 100, 400, NULL, NULL};
    zr_gltf_fields_at(file, text, path, &film_object, &given);
    out->finish.film = clamp_key(file, path, "iridescenceFactor", given.factor);
    out->finish.film_ior =
        (float)zr_gltf_clamp(file, ZR_JSON_KEY(path, "iridescenceIor"), given.ior, 1.0, FILM_IOR_MAX);
    out->finish.film_nm = (float)zr_gltf_clamp(file, ZR_JSON_KEY(path, "iridescenceThicknessMaximum"), given.thickest,
                                               0.0, ZR_FILM_NM_MAX);
    out->finish.film_thinnest = (float)zr_gltf_clamp(file, ZR_JSON_KEY(path, "iridescenceThicknessMinimum"),
                                                     given.thinnest, 0.0, ZR_FILM_NM_MAX);
    out->keys |= UINT64_C(1) << ZR_MATERIAL_FILM | UINT64_C(1) << ZR_MATERIAL_FILM_IOR |
                 UINT64_C(1) << ZR_MATERIAL_FILM_THICKNESS | UINT64_C(1) << ZR_MATERIAL_FILM_THINNEST;
    if (out->finish.film == 0.0f) return;
    read_texture(file, path, given.texture, ZR_TEXTURE_FILM, out);
    read_texture(file, path, given.thickness_texture, ZR_TEXTURE_FILM_THICKNESS, out);
}

/* ---- KHR_materials_anisotropy ---- */

struct given_anisotropy {
    double strength, rotation;
    const char *texture; /* JSON text */
};
#define AT(member) offsetof(struct given_anisotropy, member)
static const struct zr_json_field anisotropy_fields[] = {NUMBER("anisotropyStrength", AT(strength)),
                                                         NUMBER("anisotropyRotation", AT(rotation)),
                                                         TEXT("anisotropyTexture", AT(texture)), ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object anisotropy_object = ZR_JSON_OBJECT_OF("KHR_materials_anisotropy", anisotropy_fields);

#define ROTATION_MAX 1e6

static void read_anisotropy(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                            struct zr_parsed_material *out)
{
    struct given_anisotropy given = {0, 0, NULL};
    zr_gltf_fields_at(file, text, path, &anisotropy_object, &given);
    out->finish.anisotropy = clamp_key(file, path, "anisotropyStrength", given.strength);
    out->anisotropy_rotation = (double)zr_gltf_clamp(file, ZR_JSON_KEY(path, "anisotropyRotation"), given.rotation,
                                                     -ROTATION_MAX, ROTATION_MAX);
    out->keys |= UINT64_C(1) << ZR_MATERIAL_ANISOTROPY | UINT64_C(1) << ZR_MATERIAL_ANISOTROPY_ROTATION;
    if (out->finish.anisotropy > 0.0f) read_texture(file, path, given.texture, ZR_TEXTURE_ANISOTROPY, out);
}

/* ---- KHR_materials_transmission ---- */

struct given_transmission {
    double factor;
    const char *texture; /* JSON text */
};
#define AT(member) offsetof(struct given_transmission, member)
static const struct zr_json_field transmission_fields[] = {NUMBER("transmissionFactor", AT(factor)),
                                                           TEXT("transmissionTexture", AT(texture)), ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object transmission_object =
    ZR_JSON_OBJECT_OF("KHR_materials_transmission", transmission_fields);

static void read_transmission(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                              struct zr_parsed_material *out)
{
    struct given_transmission given = {0, NULL};
    zr_gltf_fields_at(file, text, path, &transmission_object, &given);
    out->finish.transmission = clamp_key(file, path, "transmissionFactor", given.factor);
    out->keys |= UINT64_C(1) << ZR_MATERIAL_TRANSMISSION;
    if (out->finish.transmission == 0.0f) return;
    read_texture(file, path, given.texture, ZR_TEXTURE_TRANSMISSION, out);
}

/* ---- KHR_materials_volume ---- */

struct given_volume {
    double thickness, color[3], distance;
    const char *texture; /* JSON text */
};
#define AT(member) offsetof(struct given_volume, member)
static const struct zr_json_field volume_fields[] = {
    NUMBER("thicknessFactor", AT(thickness)),
    TEXT("thicknessTexture", AT(texture)),
    {.key = "attenuationColor", .read = zr_gltf_three, .offset = AT(color)},
    NUMBER("attenuationDistance", AT(distance)),
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object volume_object = ZR_JSON_OBJECT_OF("KHR_materials_volume", volume_fields);

/* The distance 0 is none, as in other renderers. */
static void read_volume(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                        struct zr_parsed_material *out)
{
    struct given_volume given = {0, {1, 1, 1}, 0, NULL};
    struct zr_finish *finish = &out->finish;
    zr_gltf_fields_at(file, text, path, &volume_object, &given);
    finish->thickness =
        (float)zr_gltf_clamp(file, ZR_JSON_KEY(path, "thicknessFactor"), given.thickness, 0.0, ZR_VOLUME_MAX);
    finish->attenuation = clamp_color(file, path, "attenuationColor", given.color);
    finish->distance =
        (float)zr_gltf_clamp(file, ZR_JSON_KEY(path, "attenuationDistance"), given.distance, 0.0, DBL_MAX);
    if (!(finish->distance <= (float)ZR_VOLUME_MAX)) finish->distance = 0.0f;
    out->keys |= UINT64_C(1) << ZR_MATERIAL_THICKNESS | UINT64_C(1) << ZR_MATERIAL_ATTENUATION_COLOR |
                 UINT64_C(1) << ZR_MATERIAL_ATTENUATION_DISTANCE;
    if (finish->thickness > 0.0f && finish->transmission > 0.0f)
        read_texture(file, path, given.texture, ZR_TEXTURE_THICKNESS, out);
}

/* ---- KHR_materials_dispersion ---- */

struct given_dispersion {
    double dispersion;
};
static const struct zr_json_field dispersion_fields[] = {
    NUMBER("dispersion", offsetof(struct given_dispersion, dispersion)), ZR_GLTF_COMMON};
static const struct zr_json_object dispersion_object = ZR_JSON_OBJECT_OF("KHR_materials_dispersion", dispersion_fields);

static void read_dispersion(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                            struct zr_parsed_material *out)
{
    struct given_dispersion given = {0};
    zr_gltf_fields_at(file, text, path, &dispersion_object, &given);
    out->finish.dispersion =
        (float)zr_gltf_clamp(file, ZR_JSON_KEY(path, "dispersion"), given.dispersion, 0.0, ZR_DISPERSION_MAX);
    out->keys |= UINT64_C(1) << ZR_MATERIAL_DISPERSION;
}

/* ---- all ---- */

typedef void read_fn(struct zr_gltf *file, const struct zr_json_path *path, const char *text,
                     struct zr_parsed_material *out);

static const struct {
    const struct zr_json_object *object;
    read_fn *read;
} finishes[ZR_GLTF_FINISHES] = {[ZR_GLTF_COAT] = {&coat_object, read_coat},
                                [ZR_GLTF_SHEEN] = {&sheen_object, read_sheen},
                                [ZR_GLTF_FILM] = {&film_object, read_film},
                                [ZR_GLTF_ANISOTROPY] = {&anisotropy_object, read_anisotropy},
                                [ZR_GLTF_TRANSMISSION] = {&transmission_object, read_transmission},
                                [ZR_GLTF_VOLUME] = {&volume_object, read_volume},
                                [ZR_GLTF_DISPERSION] = {&dispersion_object, read_dispersion}};

void zr_gltf_read_finish(struct zr_gltf *file, const struct zr_json_path *path, const char *const texts[],
                         struct zr_parsed_material *out)
{
    for (int i = 0; i < ZR_GLTF_FINISHES; i++)
        if (texts[i]) finishes[i].read(file, ZR_JSON_KEY(path, finishes[i].object->name), texts[i], out);
}
