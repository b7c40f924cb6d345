/* json_texture.h - input: the textures of a material, as a scene has them.
 *
 * Keys are read where they are met; images are asked for once the root is read, when it is known what assets there are.
 */
#ifndef ZR_JSON_TEXTURE_H
#define ZR_JSON_TEXTURE_H

#include "input/json_scene.h"

/* Reads an object into a struct zr_given_texture: that of a normal map and that of occlusion have a key more. */
zr_json_read_fn zr_read_texture, zr_read_normal_texture, zr_read_occlusion_texture;

/* What materials need of their textures, in the scene: `path` is that of the list of materials. */
void zr_given_find_textures(struct zr_given_scene *root, const struct zr_json_path *path);

/* The keys of materials that have textures, by enum zr_texture_slot. */
extern const char *const zr_texture_keys[ZR_TEXTURE_SLOTS];

/* Whether the material, by its number in the scene's list, has any; false of the number behind the last one. */
bool zr_given_has_textures(const struct zr_given_scene *root, size_t material);

/* Reports, at `path`, what a mesh lacks that is drawn with the material. */
bool zr_given_check_texcoords(struct zr_given_scene *root, const struct zr_json_path *path, size_t material,
                              bool has_texcoords, bool has_texcoords1);

#endif
