/* noise_edges.h - mesh: which edges of a table are steep, but noise of a scan (crease_chains.h).
 *
 * Space:  object space. */
#ifndef ZR_NOISE_EDGES_H
#define ZR_NOISE_EDGES_H

#include "base/run.h"
#include "mesh/edge_mesh.h"

/* Returns a byte per edge of the table, 1 for noise; NULL if the crease angle allows none, if there is none, or if the
 * arena failed. Edges of two triangles count, but no diagonals of polygons. If cancelled, the bytes are undefined. */
const uint8_t *zr_noise_edges_find(const struct zr_run *run, const struct zr_mesh *mesh,
                                   const struct zr_edge_mesh *table, float crease_degrees);

#endif
