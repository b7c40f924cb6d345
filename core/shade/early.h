/* early.h - shade: colours of smooth triangles for those who draw them (zr_prepaint_fn), while corners are at hand. A
 * kernel.
 */
#ifndef ZR_EARLY_H
#define ZR_EARLY_H

#include "base/isa.h"
#include "raster/prepaint.h"

ZR_KERNEL_TABLE(zr_prepaint_fn, zr_early)

#endif
