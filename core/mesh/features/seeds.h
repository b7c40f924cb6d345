/* seeds.h - mesh: edges at which a cylinder may begin, for mesh/features/patches.c.
 *
 * Seeds:  the edges between facets that turn by up to 62 degrees, longest first. The edge is the axis; the circle goes
 *         through the edge and the far sides of both facets, whose widths differ by at most 2.5 times.
 * Tried:  only edges beside which a third facet fits are seeds. Free forms have few. The edges are tried in parallel, each
 *         with at most ZR_SEED_STEPS steps: facets of very many triangles are flat faces, not sides of a cylinder.
 */
#ifndef ZR_SEEDS_H
#define ZR_SEEDS_H

#include "base/team.h"
#include "mesh/features/patch.h"

enum { ZR_SEED_STEPS = 1024 };

struct zr_seeds {
    uint32_t count;
    const uint64_t *sides; /* in the lower half: 3 t + k; of the longest edge first */
};

/* Lists the seeds, in the arena. False without memory or steps. */
bool zr_seeds_find(struct zr_arena *arena, struct zr_team *team, struct zr_feature_work *work,
                   const struct zr_facets *facets, struct zr_seeds *out);

/* Makes a patch of the facets beside a side; its list is not set. False if they are not alike. */
bool zr_seed_plant(struct zr_feature_work *work, const struct zr_facets *facets, uint32_t side, struct zr_patch *patch);

#endif
