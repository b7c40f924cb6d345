/* winding.h - geometry: edges of a shape that is filled by the non-zero rule, for samplers of the odd-even rule.
 *
 * Space:  the snapped grid of viewport.h.
 * Why:    hidden-surface algorithms fill shapes by the odd-even rule. If rings of a cap overlap, such as those of two
 *         solids in one part, winding numbers beyond 1 occur, and the rules differ.
 * How:    if no row of samples has such a number, and no earlier cap of the plane has taken any of the samples
 *         (cap_samples.h), the edges of the rings stay. Otherwise they are replaced, row by row, by vertical edges of one
 *         row around the runs of free samples whose winding number is not 0; equal edges of neighbouring rows are
 *         joined. Both have exactly the same samples inside. */
#ifndef ZR_WINDING_H
#define ZR_WINDING_H

#include "geometry/builder.h"

/* Adds an edge to builder->winding. A failure is recorded in the arena. */
void zr_winding_note(struct zr_builder *builder, const struct zr_grid_edge *edge, int32_t sign);

/* Appends the edges of the cap in builder->winding to builder->geometry->edges, and empties it. `cap`: its number in
 * builder->mesh, counted from the first cap. Returns false if the arena failed or the request is cancelled. */
bool zr_winding_add(struct zr_builder *builder, uint32_t cap);

#endif
