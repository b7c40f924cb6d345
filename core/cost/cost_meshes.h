/* cost_meshes.h - cost: estimate of the bytes that drawing holds at once, in arrays of the sizes of meshes.
 *
 * Space:  views[0] of the scene.
 * Exact:  within a factor of two of what is held, with zr_cost_window_bytes, for scenes of `make bench-costs`.
 */
#ifndef ZR_COST_MESHES_H
#define ZR_COST_MESHES_H

#include "cost/cost_passes.h"

double zr_cost_mesh_bytes(const struct zr_scene *scene, const struct zr_cost_passes *passes);

#endif
