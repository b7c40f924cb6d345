/* section_pass.h - render: cuts the scene open before it is drawn, and restores the ids of the whole scene. */
#ifndef ZR_RENDER_SECTIONS_H
#define ZR_RENDER_SECTIONS_H

#include "base/run.h"
#include "sections/sections.h"
#include "shade/frame.h"

/* Makes the cut scene in `scratch`, and sets frame->sections: facts and the warning, in `arena`. The view is that of
 * the whole scene. Returns the scene to draw in *drawn: `scene` itself if it has no sections. Fails as
 * zr_section_planes_find and zr_sections_make do. */
enum zr_status zr_render_sections(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_resolved_view *resolved, struct zr_frame *frame,
                                  const struct zr_scene **drawn);

/* Replaces the face ids of the frame, and of its picks and fragments, which lie in `arena`. Fails with ZR_NO_MEMORY or
 * ZR_CANCELLED. */
enum zr_status zr_render_sections_restore(struct zr_arena *arena, const struct zr_cancel *cancel,
                                          struct zr_frame *frame);

#endif
