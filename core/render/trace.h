/* trace.h - render: the channel trace: draws the view once more by the scene's algorithm, which records its steps. */
#ifndef ZR_RENDER_TRACE_H
#define ZR_RENDER_TRACE_H

#include "base/team.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Makes frame->trace, allocated in `arena`; the rest goes to `scratch`, which may be the same. The frame has its
 * camera. Returns ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY, ZR_INTERNAL, or ZR_BAD_SCENE, with a fault, beyond the bounds of a
 * trace. */
enum zr_status zr_trace_make(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                             const struct zr_scene *scene, const struct zr_cancel *cancel, struct zr_frame *frame,
                             struct zr_error *error);

#endif
