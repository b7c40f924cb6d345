/* crease_chains.h - mesh: tells creases from the noise of scans, among edges that bend by more than the crease angle.
 *
 * Space:  object space; lengths relative to D, the diagonal of the mesh's bounds.
 * Why:    a scan has short steep edges everywhere. As creases, they put saw teeth into light and dashes into drawings.
 * How:    two steep edges that meet in a vertex are linked if each goes on the other most straightly, and they turn by
 *         less than 40 degrees. A steep edge is noise if it is shorter than D / 80, its chain of links is shorter than
 *         D / 20, has fewer than 12 edges and is no ring, and a face beside it is gentle: the flattest of the face's
 *         other edges, of those that touch the steep one, bends by 0.5 degrees up to the crease angle. Parts of CAD
 *         have flat faces there, or faces that are steep on all sides.
 *         The rule holds for crease angles of 20 to 60 degrees; any other angle is exact.
 * Exact:  + - * / and sqrt in the order of edges. */
#ifndef ZR_CREASE_CHAINS_H
#define ZR_CREASE_CHAINS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/vec.h"

#define ZR_SMALL_EDGE   0.0125f     /* of D */
#define ZR_FLAT_COSINE  0.99996192f /* of half a degree */
#define ZR_NO_NEIGHBOUR (-2.0f)     /* below each cosine */

enum { ZR_CREASE_DEGREES_LEAST = 20, ZR_CREASE_DEGREES_MOST = 60 };

/* An edge of two faces that bends by more than the crease angle. */
struct zr_steep_edge {
    uint32_t ends[2], positions[2]; /* vertices; index of the position of each */
    float length;
    bool has_gentle_face; /* need not be set if the edge is not small */
    bool is_crease;       /* the result */
    bool closes_ring;     /* scratch, false at first */
    uint32_t chain;       /* scratch */
};

struct zr_steep_edges {
    struct zr_steep_edge *of;
    uint32_t count, vertex_count;
    const uint32_t *starts; /* result, by vertex, and one more: the begin of its list in `listed` */
    const uint32_t *listed; /* 2 edge + end */
};

static inline bool zr_crease_degrees_allow_noise(float degrees)
{
    return degrees >= (float)ZR_CREASE_DEGREES_LEAST && degrees <= (float)ZR_CREASE_DEGREES_MOST;
}

/* True if a face is gentle. `flattest`: the largest cosine between it and a neighbour, or ZR_NO_NEIGHBOUR. */
static inline bool zr_is_gentle(float flattest, float crease_cosine)
{
    return flattest >= crease_cosine && flattest <= ZR_FLAT_COSINE;
}

/* Sets is_crease of all edges, and the lists of vertices, which live in the arena. False if the arena has failed. If
 * cancelled, returns early with undefined results. */
bool zr_crease_chains_find(struct zr_arena *arena, const struct zr_cancel *cancel, const zr_vec4 *positions,
                           float diagonal, struct zr_steep_edges *edges);

#endif
