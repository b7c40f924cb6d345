/* patches.h - mesh: patches of facets that lie on one cylinder.
 *
 * Seeds:  by mesh/features/seeds.h, the longest first.
 * Growth: a neighbour joins if its normal is at right angles to the axis and points to or away from the centre, and
 *         its two outermost corners across the axis lie on the circle. Corners between them may lie on the chord, as
 *         where other faces cut the facet. Each time a patch has doubled, axis and circle are fitted anew.
 * Kept:   patches of at least 3 facets, whose outermost corners are within 0.3 % of the radius.
 * Scans:  the search ends after 32768 consecutive seeds without a patch of at least 8 facets. The rest is free forms.
 * Free:   a patch whose ends go on smoothly, in facets of its own length, is a piece of a free form, such as a ring of
 *         a sphere: it is left out.
 */
#ifndef ZR_PATCHES_H
#define ZR_PATCHES_H

#include "mesh/features/seeds.h"

struct zr_patches {
    uint32_t count;
    const struct zr_patch *at;
    const uint32_t *facets;
};

/* Finds the patches, in the arena. False without memory or steps. */
bool zr_patches_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                     const struct zr_seeds *seeds, struct zr_patches *out);

#endif
