/* parsed_material.h - input: materials and textures as the readers of all formats hand them over.
 *
 * A parsed material holds the keys that its file or scene gives. A drawn mesh needs all values (base colour, shading,
 * sidedness): a key of the mesh overrides the material's, which overrides the scene's (scene/json_material.c).
 */
#ifndef ZR_PARSED_MATERIAL_H
#define ZR_PARSED_MATERIAL_H

#include "input/files/assets.h"
#include "scene/face_style.h"
#include "scene/scene.h"
#include "scene/texture.h"

/* Sampling of a texture: indices of enum zr_filter and enum zr_wrap. */
struct zr_parsed_sampler {
    int magnify, minify, wrap_s, wrap_t;
};

/* A texture of a material, as read. */
struct zr_parsed_texture {
    bool is_given;
    struct zr_bytes_name name;
    uint32_t texcoord;
    struct zr_parsed_sampler sampler;
    float offset[2], scale[2];
    double rotation; /* radians */
    float strength;  /* factor: normalScale or strength */
    uint32_t number; /* 1 + its index in the scene, set once the root is read; 0: none or refused */
};

/* Largest thickness of a thin film, nanometres. Thicker ones have no colours. */
#define ZR_FILM_NM_MAX 1e5

/* Largest thickness of a volume, distance of its attenuation, and dispersion. */
#define ZR_VOLUME_MAX     1e15
#define ZR_DISPERSION_MAX 1000.0

/* Keys of a material. */
enum zr_material_key {
    ZR_MATERIAL_NAME,
    ZR_MATERIAL_BASE_COLOR,
    ZR_MATERIAL_SPECULAR,
    ZR_MATERIAL_SHININESS,
    ZR_MATERIAL_METALLIC,
    ZR_MATERIAL_ROUGHNESS,
    ZR_MATERIAL_IOR,
    ZR_MATERIAL_SPECULAR_FACTOR,
    ZR_MATERIAL_SPECULAR_COLOR,
    ZR_MATERIAL_EMISSIVE,
    ZR_MATERIAL_COOL,
    ZR_MATERIAL_METALLIC_ROUGHNESS_TEXTURE,
    ZR_MATERIAL_NORMAL_TEXTURE,
    ZR_MATERIAL_OCCLUSION_TEXTURE,
    ZR_MATERIAL_EMISSIVE_TEXTURE,
    ZR_MATERIAL_COAT,
    ZR_MATERIAL_COAT_ROUGHNESS,
    ZR_MATERIAL_COAT_TEXTURE,
    ZR_MATERIAL_COAT_ROUGHNESS_TEXTURE,
    ZR_MATERIAL_COAT_NORMAL_TEXTURE,
    ZR_MATERIAL_SHEEN,
    ZR_MATERIAL_SHEEN_ROUGHNESS,
    ZR_MATERIAL_SHEEN_TEXTURE,
    ZR_MATERIAL_FILM,
    ZR_MATERIAL_FILM_IOR,
    ZR_MATERIAL_FILM_THICKNESS,
    ZR_MATERIAL_FILM_THINNEST,
    ZR_MATERIAL_FILM_TEXTURE,
    ZR_MATERIAL_FILM_THICKNESS_TEXTURE,
    ZR_MATERIAL_ANISOTROPY,
    ZR_MATERIAL_ANISOTROPY_ROTATION,
    ZR_MATERIAL_ANISOTROPY_TEXTURE,
    ZR_MATERIAL_TRANSMISSION,
    ZR_MATERIAL_TRANSMISSION_TEXTURE,
    ZR_MATERIAL_THICKNESS,
    ZR_MATERIAL_THICKNESS_TEXTURE,
    ZR_MATERIAL_ATTENUATION_COLOR,
    ZR_MATERIAL_ATTENUATION_DISTANCE,
    ZR_MATERIAL_DISPERSION,
    ZR_MATERIAL_BASE_COLOR_TEXTURE,

    /* Keys of struct zr_finish and its textures. */
    ZR_MATERIAL_FINISH_FIRST = ZR_MATERIAL_COAT,
    ZR_MATERIAL_FINISH_LAST = ZR_MATERIAL_DISPERSION
};

/* A material of the scene, as read. */
struct zr_parsed_material {
    const char *name;
    size_t number; /* index in the text's list */
    uint64_t keys; /* bit i: key i is given; the look has the others */
    zr_vec4 base_color, specular, cool;
    float shininess, metallic, roughness, ior, specular_factor;
    zr_vec3 emissive, specular_color;
    struct zr_finish finish;
    double anisotropy_rotation; /* radians */
    struct zr_parsed_texture textures[ZR_TEXTURE_SLOTS];
    struct zr_face_style face_style;
    bool blends;           /* of a file: blended, unless an alphaMode applies */
    bool is_alpha_only;    /* RGB of the texture of the base colour counts as 1 */
    bool has_linear_color; /* of a file that gives linear_color; base_color is its encoding as sRGB */
    zr_vec3 linear_color;
    bool is_used, is_masked, is_blended; /* used by a mesh; by one with the alphaMode MASK; by one with BLEND */
    uint32_t shadings;                   /* bit i: a mesh with filled faces and shading i uses it */
};

/* Keys of a material's textures, by enum zr_texture_slot. */
extern const char *const zr_texture_keys[ZR_TEXTURE_SLOTS];

/* Sets the rows of a texture, whose wrap modes are set: scales, then rotates, then translates coordinates. */
void zr_parsed_put_transform(const struct zr_parsed_texture *given, struct zr_texture *texture);

/* glTF's numbers of filters and wrap modes, by enum zr_filter and enum zr_wrap. */
extern const uint32_t zr_filter_numbers[ZR_FILTER_COUNT], zr_wrap_numbers[ZR_WRAP_COUNT];

/* The index of such a number; -1: there is none. */
int zr_filter_of_number(uint32_t number);
int zr_wrap_of_number(uint32_t number);

/* Decodes a colour of light. Numbers are linear light. A negated colour is sRGB-encoded: it becomes linear light, or
 * the values as written if light is not linear. */
zr_vec3 zr_light_color(zr_vec3 given, bool is_linear);

#endif
