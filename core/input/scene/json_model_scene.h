/* json_model_scene.h - input: materials, cameras and lights of model files, applied to a scene that is read. */
#ifndef ZR_JSON_MODEL_SCENE_H
#define ZR_JSON_MODEL_SCENE_H

#include "input/model/model_scene.h"
#include "input/scene/json_scene.h"

/* Makes the materials of the builder's meshes from those of the file. The keys of the query override them. */
void zr_model_scene_make_materials(struct zr_parsed_scene *root, const struct zr_model_scene *file);

/* Makes the materials of mesh `which` of the file. root->materials begins with the file's materials; the next one is
 * for faces without a material. The keys of the style override the materials. */
void zr_model_scene_make_mesh(struct zr_parsed_scene *root, const struct zr_model_scene *file, uint32_t which,
                              const struct zr_style *style, struct zr_mesh *mesh);

/* Leaves of a file's material its opacity, its sides and its maps of normals and occlusion if the scene's look is a
 * material, unless materials are kept. Removes its shading if the look does not light surfaces. */
void zr_model_scene_fit_look(const struct zr_parsed_scene *root, struct zr_parsed_material *material);

/* Removes the colours of a file's mesh if the scene's look is a material, unless materials are kept. Colours of scalars
 * stay. */
void zr_model_scene_fit_colors(const struct zr_parsed_scene *root, struct zr_mesh *mesh);

/* Sets the view's pose, projection and planes to those of the file's camera of this name or number, except the keys in
 * root->gives_projection, gives_znear and gives_zfar. `up` turns the file's space to world space. False, and a fault at
 * `path`, if there is no such camera, or its planes and those of the view are in the wrong order. `file` may be
 * NULL. */
bool zr_model_scene_use_camera(struct zr_parsed_scene *root, const struct zr_json_path *path,
                               const struct zr_model_scene *file, const char *camera, const zr_mat4 *up);

/* Replaces the scene's lights by the file's lights, as the key `lights` does.
 * Warns if the file has none. `up`: as above. */
void zr_model_scene_use_lights(struct zr_parsed_scene *root, const struct zr_model_scene *file, const zr_mat4 *up);

/* Reports at `path` that the file has no such animation. `file` may be NULL. */
void zr_model_scene_refuse_animation(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                     const struct zr_model_scene *file, const char *wanted);

/* Removes the maps that need linear light if the picture is made without it. */
void zr_parsed_drop_maps(struct zr_parsed_scene *root);

#endif
