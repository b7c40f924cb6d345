/* json_model.h - input: meshes of a JSON scene that are model files, such as {"asset": "robot.glb"}.
 *
 * Order:  a file is read with the list of meshes; its materials and instances are made once the root is read.
 * Axes:   those of the file. A far origin (far.h) is added to its instances again.
 * Meshes: mesh i of the list is mesh i of the scene. Further meshes of its file are behind those of the list and the
 *         polygons; scene->mesh_owners has their i.
 */
#ifndef ZR_JSON_MODEL_H
#define ZR_JSON_MODEL_H

#include "input/json_mesh.h"

/* A model file as read. It does not change afterwards. */
struct zr_model;

/* Reads the file of a mesh. `path`: of the mesh. NULL after a fault. */
struct zr_model *zr_model_read(struct zr_parsed_scene *root, const struct zr_json_path *path,
                               const struct zr_bytes_name *name);

/* Numbers the meshes of all files beyond the first of each, from `first` on. Sets scene->mesh_owners, or leaves it NULL
 * if there are no files. Returns their count. */
uint32_t zr_models_number(struct zr_parsed_scene *root, uint32_t first);

/* Makes the meshes of a file, after zr_models_number: one in its place of the list, the others at their numbers. Faces
 * have the material of `style`, else the file's. `path`: of the mesh. */
void zr_model_make(struct zr_parsed_scene *root, const struct zr_json_path *path, const struct zr_parsed_mesh *given,
                   const struct zr_style *style, struct zr_mesh *meshes);

/* Makes root->camera the view: of the first instance of a file with this camera. A fault at `path` if there is none. */
void zr_models_use_camera(struct zr_parsed_scene *root, const struct zr_json_path *path,
                          const struct zr_instance *instances, uint32_t count);

/* Replaces each instance of a file by the instances of its meshes. Returns the new array and its length in *count; the
 * given one if there are no files; NULL after a fault at `path`. */
struct zr_instance *zr_models_place(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                    struct zr_instance *instances, uint32_t *count);

#endif
