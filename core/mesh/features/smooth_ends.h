/* smooth_ends.h - mesh: tells a cylinder from a piece of a free form, for mesh/features/patches.c.
 *
 * Rule:   an end of a patch goes on smoothly if, along more than half of its arc, the next facets turn by less than 28
 *         degrees. A free form goes on so at both ends in facets at least a third as long as the patch, or at one end
 *         in facets at least 0.6 times as long. Fillets at the rim of a hole are shorter; countersinks turn more.
 */
#ifndef ZR_SMOOTH_ENDS_H
#define ZR_SMOOTH_ENDS_H

#include "mesh/features/patch.h"

/* Returns true if a patch is a piece of a free form. `owners` names the patch of each facet: `own` is this one. */
bool zr_patch_is_free(struct zr_feature_work *work, const struct zr_facets *facets, const struct zr_patch *patch,
                      const uint32_t *list, const uint32_t *owners, uint32_t own);

#endif
