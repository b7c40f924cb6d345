/* shells.h - mesh: connected surfaces of the parts of a mesh, by a forest of their faces.
 *
 * Rule:   faces of a part that share an edge belong to one shell. So surfaces that touch along an edge are one shell,
 *         and those that touch at a corner are several. A face without a counted edge (closed_parts.h) is in no shell.
 * Kinds:  a shell is closed by the rule of closed_parts.h, else open. A closed shell is inward if its volume is
 *         negative: a void, or a surface that is inside out. It is flat if rounded coordinates can make its volume,
 *         such as that of a sheet with two sides; else outward.
 * Exact:  the same for all instruction sets and numbers of threads. */
#ifndef ZR_SHELLS_H
#define ZR_SHELLS_H

#include <stdatomic.h>

#include "core.h"
#include "scene/scene.h"

/* Edges that keep a part from being closed. */
struct zr_odd_edges {
    uint32_t count;
    uint32_t at; /* slot of a corner in mesh->indices: one of them ends there; the one of the lowest face */
};

struct zr_shells {
    uint32_t outward, inward, flat, open;
    struct zr_odd_edges open_edges;    /* used by an odd number of faces */
    struct zr_odd_edges flipped_edges; /* by an even number, more often in one direction: a face there is flipped */
};

/* Each face has a parent, of a lower number or itself; the root of a tree is the first face of its shell. */
struct zr_shell_forest {
    const struct zr_mesh *mesh;
    _Atomic uint32_t *parents; /* UINT32_MAX: in no shell */
    atomic_uchar *is_open;     /* of a shell, at any of its faces */
};

/* Puts all faces into no shell. If cancelled, returns early with undefined values. */
void zr_shell_forest_clear(const struct zr_shell_forest *forest, const struct zr_cancel *cancel);

/* Makes a shell of a face that is in none. */
static inline void zr_shell_forest_plant(const struct zr_shell_forest *forest, uint32_t face)
{
    if (atomic_load_explicit(&forest->parents[face], memory_order_relaxed) == UINT32_MAX)
        atomic_store_explicit(&forest->parents[face], face, memory_order_relaxed);
}

/* Joins the shells of two faces. Thread-safe. */
void zr_shell_forest_join(const struct zr_shell_forest *forest, uint32_t a, uint32_t b);

/* Adds the shells of each part to `shells`, when all are joined. `volumes` has room for two numbers per face. If
 * cancelled, returns early with undefined values. */
void zr_shells_count(const struct zr_shell_forest *forest, const struct zr_cancel *cancel, double *volumes,
                     struct zr_shells *shells);

#endif
