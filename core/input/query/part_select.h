/* part_select.h - input: finds the parts that the keys of a scene name, and edits the scene by these keys
 * (scene/part_keys.h, scene/parts/part_edit.h).
 *
 * Order:  a part is hidden if `hide` has it, or if `isolate` is given without it. The last highlight that has a part
 *         sets its colour. Parts without a highlight get the colour of `colors`.
 */
#ifndef ZR_PART_SELECT_H
#define ZR_PART_SELECT_H

#include "base/status.h"
#include "scene/scene_builder.h"

/* Maximum number of parts in a scene with these keys. */
enum { ZR_PARTS_SELECTED_MAX = 1 << 17 };

/* Applies scene->parts to the scene of a closed builder. Adds warnings about keys without an effect. Returns
 * ZR_BAD_SCENE, with the pointers of the keys, if a name, pattern or id matches no part, if no part is left to draw, or
 * if keys exclude one another. Returns ZR_NO_MEMORY without memory, or if arena->cancel is raised. */
enum zr_status zr_parts_apply(struct zr_scene_builder *builder, struct zr_error *error);

/* Checks that the parts which sections leave uncut exist, in the scene after zr_parts_apply. Returns ZR_BAD_SCENE, with
 * the pointers of unknown names, and ZR_NO_MEMORY as zr_parts_apply does. */
enum zr_status zr_parts_check_uncut(struct zr_scene_builder *builder, struct zr_error *error);

#endif
