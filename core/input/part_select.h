/* part_select.h - input: finds the parts that the keys of a scene name, and edits the scene by these keys
 * (scene/part_keys.h, scene/part_edit.h).
 *
 * Order:  a part is hidden if `hide` has it, or if there is an `isolate` without it. The last highlight with a part
 *         gives its colour; else `colors` does.
 */
#ifndef ZR_PART_SELECT_H
#define ZR_PART_SELECT_H

#include "base/status.h"
#include "scene/scene_builder.h"

/* Most parts of a scene with these keys. */
enum { ZR_PARTS_SELECTED_MAX = 1 << 17 };

/* Edits the scene of a closed builder by scene->parts. ZR_BAD_SCENE, with the pointers of the keys, if a name, pattern
 * or id matches no part, if no part is left to draw, or if keys exclude one another. ZR_NO_MEMORY, also if arena->cancel
 * is raised. Adds warnings of keys without an effect. */
enum zr_status zr_parts_apply(struct zr_scene_builder *builder, struct zr_error *error);

#endif
