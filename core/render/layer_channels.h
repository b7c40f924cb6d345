/* layer_channels.h - render: the channels layers and thickness.
 *
 * Each is drawn in a pass of its own, in which every surface is transparent (layer_pass.h).
 * layers:    number of fragments per pixel.
 * thickness: length of the ray inside closed meshes, in scene units. Both sides of faces are drawn. From behind, each
 *            back face adds 1 to the winding number and each front face subtracts 1. The ray is inside where the number
 *            is not 0. A span that never returns to 0 (an open surface) counts nothing. Lines, points and outlines have
 *            no inside.
 */
#ifndef ZR_LAYER_CHANNELS_H
#define ZR_LAYER_CHANNELS_H

#include "base/run.h"
#include "base/team.h"
#include "scene/channels.h"
#include "scene/scene.h"
#include "shade/frame.h"

static inline bool zr_layer_channels_are_wanted(const struct zr_frame *frame)
{
    return frame->channels[ZR_CHANNEL_LAYERS] || frame->channels[ZR_CHANNEL_THICKNESS];
}

/* Writes whichever of the two channels the frame has. Returns ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. */
enum zr_status zr_layer_channels_draw(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

#endif
