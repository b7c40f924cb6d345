/* shadow_map_kernel.h - support: zr_shadow_share_v of shade/lights/shadow_map_simd.h on arrays, for each instruction
 * set. */
#ifndef ZR_TEST_SHADOW_MAP_KERNEL_H
#define ZR_TEST_SHADOW_MAP_KERNEL_H

#include <stddef.h>

#include "base/isa.h"
#include "shade/lights/shadow_map.h"

/* `count` is a multiple of 16. */
typedef void shadow_shares_fn(const struct zr_shadow_map *map, const float *const point[3],
                              const float *const normal[3], size_t count, float *out);

ZR_KERNEL_TABLE(shadow_shares_fn, shadow_shares)

#endif
