/* alpha_range.h - scene: range of alpha over a list of colours. */
#ifndef ZR_ALPHA_RANGE_H
#define ZR_ALPHA_RANGE_H

#include <stddef.h>

#include "base/vec.h"

struct zr_alpha_range {
    float least, most;
};
static const struct zr_alpha_range zr_alpha_opaque = {1.0f, 1.0f};

/* Returns the range of the colours' alphas; {1, 1} if `colors` is NULL or empty. */
struct zr_alpha_range zr_alpha_range_of(const zr_vec4 *colors, size_t count);
/* Returns the range of products of an alpha of `a` and one of `b`. */
struct zr_alpha_range zr_alpha_range_times(struct zr_alpha_range a, struct zr_alpha_range b);

#endif
