/* solid_walk.h - render: visible surfaces of combined solids (scene/csg.h), tile by tile.
 *
 * How:   all fragments of the operands' faces are listed (raster/fragments.h) and walked from the eye on. A front makes
 *        the winding number of its part greater by 1, a back less by 1. The first fragment at which the value of the
 *        tree changes is visible, with the material, ids and depth of its face; all later passes take it as an opaque
 *        one.
 * Start: windings end with 0. If the near plane cuts operands, their windings at the eye are therefore those that the
 *        fragments lack to 0.
 * Ties:  faces within zr_csg.tolerance along the ray lie at one place; the tree is evaluated once behind all of them,
 *        and the earliest face of a part that changed there is visible. Depths that the float z-buffer cannot tell
 *        apart are computed again in double, from the meshes' own triangles (shade/eye/eye_depth.h).
 * Exact: the same for all algorithms, tiles, threads and instruction sets.
 * Source: Goldfeather, Molnar, Turk & Fuchs, "Near Real-Time CSG Rendering Using Tree Normalization and Geometric
 *        Pruning", 1989; lists of fragments in place of passes.
 */
#ifndef ZR_SOLID_WALK_H
#define ZR_SOLID_WALK_H

#include "render/layers/layers.h"

/* Adds the solids' visible surfaces to a tile of opaque ones, all samples of which it writes if there are any. Returns
 * false if cancelled or out of memory. */
bool zr_solids_put(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                   struct zr_tile *tile);

#endif
