/* instance_masks.h - render: pixels of each instance, drawn alone and as it is visible.
 *
 * All instances are drawn in one pass that keeps hidden fragments (raster/fragments.h). Instances and pixels are those
 * of the channel instanceId: masked surfaces count if they pass their mask, blended ones never.
 * Memory: three bits per pixel of an instance, in tiles and rows of 64 pixels.
 */
#ifndef ZR_INSTANCE_MASKS_H
#define ZR_INSTANCE_MASKS_H

#include "base/run.h"
#include "base/team.h"
#include "shade/frame.h"

/* Writes frame->masks, allocated in `arena`; the rest goes to `scratch`, which may be the same. The frame has its
 * instanceId. Returns ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. */
enum zr_status zr_instance_masks_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

/* Makes room for the bits of a mask, whose `amodal` is set. All are 0. The arena fails without memory. */
void zr_instance_mask_make_bits(struct zr_arena *arena, struct zr_instance_mask *mask);

#endif
