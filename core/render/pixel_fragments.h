/* pixel_fragments.h - render: all that lies over one pixel: the channel fragments, the base of picking.
 *
 * From the tile that the pixel lies in, in a pass in which everything is see-through (layer_pass.h). Which fragments
 * are shown, the pixel's own channels tell: the one that windowDepth and faceId are of, and what is blended in front of
 * it.
 */
#ifndef ZR_PIXEL_FRAGMENTS_H
#define ZR_PIXEL_FRAGMENTS_H

#include "base/team.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Finds frame->fragments, in the arena, of the pixel x, y of the window, once the frame has windowDepth and faceId.
 * ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. */
enum zr_status zr_pixel_fragments_find(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                       uint32_t x, uint32_t y, const struct zr_cancel *cancel, struct zr_frame *frame);

#endif
