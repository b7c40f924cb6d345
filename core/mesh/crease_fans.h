/* crease_fans.h - mesh: corner normals at vertices whose faces differ by more than the crease angle.
 *
 * Space:  object space.
 * Why:    on a rim that bends in small steps, each face averages only those within the crease angle of itself, so that
 *         neighbours get different normals. In fine meshes, and across noise (crease_chains.h), light has saw teeth.
 * How:    vertices with an edge of D / 80 or longer, or with more than 16 corners, keep the rule of crease_normals.h, D
 *         being the diagonal of the mesh's bounds. At the others, the faces that are
 *         joined by edges that are no creases form a fan. A face beyond the crease angle of another one of its fan
 *         still counts, by (cosine - cos 75) / (cosine of the crease angle - cos 75), at least 0.
 * Exact:  sums in the order of faces; + - * / and sqrt only. */
#ifndef ZR_CREASE_FANS_H
#define ZR_CREASE_FANS_H

#include "base/run.h"
#include "mesh/crease_sums.h"

struct zr_corner_mesh {
    const struct zr_mesh *mesh; /* positions with w = 1 */
    const uint32_t *vertices;   /* by position; NULL: its own number */
    uint32_t vertex_count;
    struct zr_vertex_corners of; /* with `bent`: corners of those vertices are as zr_crease_corners made them */
    float cosine, diagonal;
    zr_vec4 *corners;
};

/* Replaces the corners of bent vertices by corner normals, and marks them (zr_crease_mark_equal). Returns the sum of
 * its results. Takes 4 bytes per vertex, and 48 per edge that bends by more than the crease angle, of scratch from the
 * arena. If the arena fails or the run is cancelled, they are undefined. */
size_t zr_crease_fans_apply(const struct zr_run *run, const struct zr_corner_mesh *mesh);

#endif
