/* gltf_extensions.h - input: functions that read extensions of glTF; private to its readers. */
#ifndef ZR_GLTF_EXTENSIONS_H
#define ZR_GLTF_EXTENSIONS_H

#include "input/codecs/meshopt.h"
#include "input/gltf/gltf_file.h"

/* ---- gltf_meshopt.c: both extensions are read alike ---- */

#define ZR_GLTF_MESHOPT     "EXT_meshopt_compression"
#define ZR_GLTF_KHR_MESHOPT "KHR_meshopt_compression"

/* Reads the extension of a view. `path` leads to the extension. */
struct zr_gltf_compressed {
    struct zr_gltf_span span;
    struct zr_meshopt layout;
};
bool zr_gltf_read_compressed(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_view *view,
                             struct zr_gltf_compressed *out);

/* Decodes compressed bytes to new memory. */
bool zr_gltf_decompress(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_compressed *given,
                        const struct zr_parsed_bytes *packed, struct zr_parsed_bytes *out);

#define ZR_GLTF_DRACO "KHR_draco_mesh_compression" /* gltf_parts.h reads it */

/* ---- gltf_instancing.c: EXT_mesh_gpu_instancing ---- */

#define ZR_GLTF_INSTANCING "EXT_mesh_gpu_instancing"

/* Reads the poses of an entry of file->uses with instancing. False after a fault. */
bool zr_gltf_read_poses(struct zr_gltf *file, struct zr_gltf_use *use);

/* ---- gltf_specular.c ---- */

/* Reflectance at normal incidence for an index of 1.5, the default of the shading pbr and of KHR_materials_ior. */
#define ZR_GLTF_PLASTIC 0.04

/* Reads the reflectance of a material. Counts textures for a warning, since they are not drawn. `path` leads to its
 * extensions. `ior`, `specular`: JSON text of KHR_materials_ior and KHR_materials_specular, or NULL. */
void zr_gltf_read_reflectance(struct zr_gltf *file, const struct zr_json_path *path, const char *ior,
                              const char *specular, struct zr_parsed_material *out);

/* KHR_materials_pbrSpecularGlossiness, converted to a metallic-roughness material; the colour is linear. */
struct zr_gltf_glossiness {
    float color[4], metallic, roughness;
    struct zr_parsed_texture color_texture, rough_texture;
};
void zr_gltf_read_glossiness(struct zr_gltf *file, const struct zr_json_path *path, const char *place,
                             struct zr_gltf_glossiness *out);

/* gltf_texture.c: the two steps of zr_gltf_read_texture. zr_gltf_find_texture reads the texture and decodes its image.
 * It returns false after a fault, or if there is no image, which a warning counts. zr_gltf_add_texture adds the texture
 * to the scene, and returns false after a fault. */
bool zr_gltf_find_texture(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                          enum zr_texture_slot slot, struct zr_parsed_texture *out, struct zr_texture *texture);
bool zr_gltf_add_texture(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_texture *texture,
                         struct zr_parsed_texture *out);

/* ---- gltf_finish.c ---- */

enum zr_gltf_finish {
    ZR_GLTF_COAT,
    ZR_GLTF_SHEEN,
    ZR_GLTF_FILM,
    ZR_GLTF_ANISOTROPY,
    ZR_GLTF_TRANSMISSION,
    ZR_GLTF_VOLUME,
    ZR_GLTF_DISPERSION,
    ZR_GLTF_FINISHES
};

/* Reads the finish of a material. `path` leads to its extensions. texts: JSON text of each extension, or NULL. Counts
 * textures that are not drawn, for a warning. */
void zr_gltf_read_finish(struct zr_gltf *file, const struct zr_json_path *path, const char *const texts[],
                         struct zr_parsed_material *out);

/* ---- gltf_gloss.c ---- */

/* Converts linear colours within 0..1. Sets color[0..2] and metallic.
 * Source: the conversion that Khronos published with the extension (examples/convert-between-workflows). */
void zr_gltf_convert_glossiness(const double diffuse[3], const double specular[3], struct zr_gltf_glossiness *out);

struct zr_gltf_gloss {
    double diffuse[3], specular[3], glossiness; /* factors of both textures */
};

/* The result of a conversion, and its inputs. All images are numbers of the scene's images. */
struct zr_gltf_baked {
    struct zr_gltf_gloss factors;
    bool has_diffuse;
    uint32_t diffuse, specular; /* the given images */
    uint32_t color, rough;      /* results. color: sRGB and alpha; rough: roughness in green, metalness in blue */
};

/* Converts a specular-glossiness image and a diffuse image (NULL: white) texel by texel. Equal inputs are converted
 * once. Returns NULL after 64 conversions, beyond the limit of texels, without memory, or if cancelled. */
const struct zr_gltf_baked *zr_gltf_bake_glossiness(struct zr_gltf *file, const struct zr_gltf_gloss *factors,
                                                    const uint32_t *diffuse, uint32_t specular);

/* ---- gltf_light.c: KHR_lights_punctual ---- */

/* Returns the light of a node's extensions, or NONE. */
uint32_t zr_gltf_find_light(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions);

/* Adds a light to the lights of the file's scene, in the pose of a node. */
void zr_gltf_place_light(struct zr_gltf *file, uint32_t node, uint32_t light, const zr_mat4 *world);

/* ---- gltf_extension.c ---- */

/* Finds one extension in an object of extensions. Sets *place to the JSON text of the extension, or leaves it unchanged
 * if there is none. False after a fault. `extensions`: JSON text of the object. */
bool zr_gltf_find_extension(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions,
                            const char *name, const char **place);

#endif
