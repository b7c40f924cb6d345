/* scene_edit.h - scene: copies a scene with changed materials, for passes that draw it differently, and removes
 * colours.
 */
#ifndef ZR_SCENE_EDIT_H
#define ZR_SCENE_EDIT_H

#include "base/arena.h"
#include "scene/scene.h"

/* Changes one material in place. */
typedef void zr_material_edit_fn(struct zr_material *material);

/* Copies the scene and its materials, and edits each copied material. Materials keep their numbers. The copy shares
 * everything else with `scene`. False: the arena has no memory. */
bool zr_scene_edit_materials(struct zr_arena *arena, const struct zr_scene *scene, zr_material_edit_fn *edit,
                             struct zr_scene *out);

/* Removes the colours of vertices and faces. False: the arena has no memory. */
bool zr_scene_drop_colors(struct zr_arena *arena, struct zr_scene *scene);

#endif
