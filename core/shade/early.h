/* early.h - shade: colours of smooth triangles, computed at rasterization while their corners are in registers
 * (zr_prepaint_fn). A kernel. */
#ifndef ZR_EARLY_H
#define ZR_EARLY_H

#include "base/isa.h"
#include "raster/prepaint.h"

ZR_KERNEL_TABLE(zr_prepaint_fn, zr_early)

#endif
