/* alpha_range.h - scene: the alphas that colours have, from the least to the most. */
#ifndef ZR_ALPHA_RANGE_H
#define ZR_ALPHA_RANGE_H

#include <stddef.h>

#include "base/vec.h"

struct zr_alpha_range {
    float least, most;
};
static const struct zr_alpha_range zr_alpha_opaque = {1.0f, 1.0f};

/* Of colours, and of products of two such; opaque where there are none. */
struct zr_alpha_range zr_alpha_range_of(const zr_vec4 *colors, size_t count);
struct zr_alpha_range zr_alpha_range_times(struct zr_alpha_range a, struct zr_alpha_range b);

#endif
