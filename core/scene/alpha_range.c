#include "scene/alpha_range.h"

struct zr_alpha_range zr_alpha_range_of(const zr_vec4 *colors, size_t count)
{
    if (!colors || count == 0) return zr_alpha_opaque;
    struct zr_alpha_range range = {colors[0].w, colors[0].w};
    for (size_t i = 1; i < count; i++) {
        range.least = colors[i].w < range.least ? colors[i].w : range.least;
        range.most = colors[i].w > range.most ? colors[i].w : range.most;
    }
    return range;
}

struct zr_alpha_range zr_alpha_range_times(struct zr_alpha_range a, struct zr_alpha_range b)
{
    return (struct zr_alpha_range){a.least * b.least, a.most * b.most};
}
