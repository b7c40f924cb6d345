/* picture.h - render: the channel color with several samples per pixel, linear light or effects. */
#ifndef ZR_LOOK_PICTURE_H
#define ZR_LOOK_PICTURE_H

#include "base/run.h"
#include "base/team.h"
#include "scene/picture.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Returns true if the channel color is drawn in passes of its own, apart from the data channels. */
static inline bool zr_picture_has_own_passes(const struct zr_picture *picture)
{
    return picture->is_linear || picture->side > 1;
}

/* Returns the scene that pictures show: surfaces with the shading xray are blended and double-sided. *out is `scene`
 * itself or `edited`. False without memory. */
bool zr_picture_scene(struct zr_arena *arena, const struct zr_scene *scene, struct zr_scene *edited,
                      const struct zr_scene **out);

/* Draws frame->color. The frame has its camera and bounds. Returns ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. */
enum zr_status zr_picture_draw(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

#endif
