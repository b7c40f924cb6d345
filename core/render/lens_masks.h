/* lens_masks.h - render: masks of instances through a lens, from those of the pinhole picture. */
#ifndef ZR_LENS_MASKS_H
#define ZR_LENS_MASKS_H

#include "base/run.h"
#include "effects/remap.h"
#include "shade/frame.h"

/* Writes frame->masks, allocated in `arena`: a pixel has the bits of the nearest pixel of the pinhole picture, as in
 * the channel instanceId. Returns ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_lens_masks_take(const struct zr_run *run, const struct zr_remap *remap,
                                  const struct zr_instance_masks *pinhole, struct zr_frame *frame);

#endif
