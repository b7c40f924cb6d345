/* file_scene.h - input: nodes and materials of a bare mesh whose format has them, such as glTF.
 *
 * Over:   a parameter of the query replaces the file's value, which replaces the look's.
 */
#ifndef ZR_FILE_SCENE_H
#define ZR_FILE_SCENE_H

#include "scene/scene.h"

struct zr_parsed_material; /* json_scene.h */
struct zr_parsed_scene;

#define ZR_FILE_MATERIAL_NONE UINT32_MAX

struct zr_file_scene {
    uint32_t instance_count;
    struct zr_instance *instances;
    uint32_t material_count;
    struct zr_parsed_material *materials;
    const uint32_t *mesh_materials; /* one per mesh: its material, or NONE: the look's */
};

/* Makes the materials of the builder's meshes: those of the file, under the keys of the query. */
void zr_file_scene_make_materials(struct zr_parsed_scene *root, const struct zr_file_scene *file);

/* Removes maps that need linear light, if the picture has none. */
void zr_file_scene_drop_maps(struct zr_parsed_scene *root);

#endif
