/* flow.h - render: draws the target of the channel flow, before the channel itself is drawn (shade/visible_points.h).
 */
#ifndef ZR_RENDER_FLOW_H
#define ZR_RENDER_FLOW_H

#include "base/run.h"
#include "base/team.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Sets frame->flow. `scene` is the drawn one. Returns ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. */
enum zr_status zr_flow_target_draw(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

#endif
