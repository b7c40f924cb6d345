/* picture.h - render, the whole floor: the channel color of what is more than one sample a pixel in the textbook's way:
 * several samples, linear light, effects.
 */
#ifndef ZR_LOOK_PICTURE_H
#define ZR_LOOK_PICTURE_H

#include "base/team.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* True where the channel color takes these stages, and not the tiles of the data channels. */
static inline bool zr_picture_has_own_passes(const struct zr_picture *picture)
{
    return picture->is_linear || picture->side > 1;
}

/* Draws frame->color. The frame has the camera and the bounds. ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. */
enum zr_status zr_picture_draw(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                               const struct zr_cancel *cancel, struct zr_frame *frame);

#endif
