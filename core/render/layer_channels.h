/* layer_channels.h - render: how many fragments lie over a pixel, and what they enclose: the channels layers and
 * thickness.
 *
 * In passes of their own, in which everything is see-through (layer_pass.h).
 * layers:    how many fragments there are.
 * thickness: how much of the ray lies inside, in scene units, for closed meshes. Faces are seen from both sides here;
 *            from behind, each back adds one to the winding number and each front takes one away; the ray is inside
 *            where that is not 0. Where surfaces are open it may never become 0 again: what is not closed counts
 *            nothing. Lines, points and outlines have no inside.
 */
#ifndef ZR_LAYER_CHANNELS_H
#define ZR_LAYER_CHANNELS_H

#include "base/team.h"
#include "scene/scene.h"
#include "shade/frame.h"

static inline bool zr_layer_channels_are_wanted(const struct zr_frame *frame)
{
    return frame->channels[ZR_CHANNEL_LAYERS] || frame->channels[ZR_CHANNEL_THICKNESS];
}

/* Writes those of the two that the frame has. ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. */
enum zr_status zr_layer_channels_draw(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                      const struct zr_cancel *cancel, struct zr_frame *frame);

#endif
