/* cost_meshes.h - cost: estimates the bytes that drawing holds at once in arrays whose length is that of meshes.
 *
 * Space:  views[0] of the scene.
 * Exact:  no. `make bench-costs` prints the estimate, with zr_cost_window_bytes and the scene, beside the bytes held.
 */
#ifndef ZR_COST_MESHES_H
#define ZR_COST_MESHES_H

#include "cost/cost_passes.h"

double zr_cost_mesh_bytes(const struct zr_scene *scene, const struct zr_cost_passes *passes);

#endif
