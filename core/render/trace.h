/* trace.h - render: the channel trace: draws the view once more by the scene's algorithm, which records its steps. */
#ifndef ZR_RENDER_TRACE_H
#define ZR_RENDER_TRACE_H

#include "base/run.h"
#include "base/team.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Makes frame->trace, allocated in `arena`; the rest goes to `scratch`, which may be the same. The frame has its
 * camera. Returns ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY, ZR_INTERNAL, or ZR_BAD_SCENE, with a fault, beyond the bounds of a
 * trace. */
enum zr_status zr_trace_make(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

#endif
