/* csg_check.h - request: checks the operands of combined solids (scene/csg.h).
 *
 * Operands are closed, filled and opaque: without an inside, or with faces that show others, there is no solid. */
#ifndef ZR_CSG_CHECK_H
#define ZR_CSG_CHECK_H

#include "base/status.h"
#include "scene/scene_builder.h"

/* Checks the operands of the edited scene, and sets the tolerance of its solids. Returns ZR_BAD_SCENE with the names of
 * operands that are open, unfilled, outlined or translucent; ZR_NO_MEMORY without memory, or if arena->cancel is
 * raised. */
enum zr_status zr_csg_check(struct zr_scene_builder *builder, struct zr_error *error);

#endif
