#include "mesh/facts/shells.h"

#include "base/cancel.h"
#include "mesh/facts/ring_area.h"
#include "scene/parts/part_list.h"

/* Precision of coordinates, relative to the largest one. */
#define PRECISION 0x1p-22

enum { FACES_PER_CANCEL_CHECK = 1 << 14 };

/* ---- the forest ---- */

void zr_shell_forest_clear(const struct zr_shell_forest *forest, const struct zr_cancel *cancel)
{
    for (uint32_t face = 0; face < forest->mesh->face_count; face++) {
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        atomic_init(&forest->parents[face], UINT32_MAX);
        atomic_init(&forest->is_open[face], 0);
    }
}

/* Returns the root of a face, and shortens its way. */
static uint32_t root_of(const struct zr_shell_forest *forest, uint32_t face)
{
    for (;;) {
        uint32_t parent = atomic_load_explicit(&forest->parents[face], memory_order_relaxed);
        if (parent == face) return face;
        const uint32_t above = atomic_load_explicit(&forest->parents[parent], memory_order_relaxed);
        if (above != parent)
            atomic_compare_exchange_weak_explicit(&forest->parents[face], &parent, above, memory_order_relaxed,
                                                  memory_order_relaxed);
        face = above;
    }
}

/* Source: Anderson and Woll, "Wait-free parallel algorithms for the union-find problem", STOC 1991. */
void zr_shell_forest_join(const struct zr_shell_forest *forest, uint32_t a, uint32_t b)
{
    for (;;) {
        a = root_of(forest, a);
        b = root_of(forest, b);
        if (a == b) return;
        const uint32_t low = a < b ? a : b;
        uint32_t high = a < b ? b : a;
        if (atomic_compare_exchange_strong_explicit(&forest->parents[high], &high, low, memory_order_relaxed,
                                                    memory_order_relaxed))
            return;
    }
}

/* ---- counting ---- */

static uint32_t shell_of(const struct zr_shell_forest *forest, uint32_t face)
{
    return atomic_load_explicit(&forest->parents[face], memory_order_relaxed);
}

static bool is_open(const struct zr_shell_forest *forest, uint32_t shell)
{
    return atomic_load_explicit(&forest->is_open[shell], memory_order_relaxed);
}

/* Makes each face a child of its root, marks the roots of open shells, and clears the sums. */
static bool find_roots(const struct zr_shell_forest *forest, const struct zr_cancel *cancel, double *volumes)
{
    for (uint32_t face = 0; face < forest->mesh->face_count; face++) {
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        volumes[2 * (size_t)face] = volumes[2 * (size_t)face + 1] = 0.0;
        if (shell_of(forest, face) == UINT32_MAX) continue;
        const uint32_t root = root_of(forest, face);
        atomic_store_explicit(&forest->parents[face], root, memory_order_relaxed);
        if (is_open(forest, face)) atomic_store_explicit(&forest->is_open[root], 1, memory_order_relaxed);
    }
    return true;
}

/* Returns the first corner of a shell, as that of an empty ring. */
static struct zr_ring_area apex_of(const struct zr_mesh *mesh, uint32_t shell)
{
    const uint32_t corner = mesh->face_offsets[shell];
    return zr_ring_area_of(mesh, corner, corner);
}

/* Adds six times the volume of the pyramid over a face, and twice the face's area, to the sums of its shell. */
static void add_face(const struct zr_mesh *mesh, uint32_t face, uint32_t shell, double sums[2])
{
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    const struct zr_ring_area apex = apex_of(mesh, shell);
    const bool is_cap = zr_mesh_face_is_cap(mesh, face);
    struct zr_ring_area first = apex;
    for (uint32_t r = 0; r < rings.count; r++) {
        const struct zr_ring_area ring = zr_ring_area_of(mesh, rings.offsets[r], rings.offsets[r + 1]);
        const double volume =
            ((ring.first[0] - apex.first[0]) * ring.area[0] + (ring.first[1] - apex.first[1]) * ring.area[1]) +
            (ring.first[2] - apex.first[2]) * ring.area[2];
        const bool is_reversed = r > 0 && !is_cap && zr_ring_areas_agree(&first, &ring);
        if (r == 0) first = ring;
        sums[0] += is_reversed ? -volume : volume;
        sums[1] += sqrt((ring.area[0] * ring.area[0] + ring.area[1] * ring.area[1]) + ring.area[2] * ring.area[2]);
    }
}

/* Returns true if rounded coordinates alone can make such a volume. `volume` is six times the shell's, `area` twice. */
static bool is_flat(const struct zr_mesh *mesh, uint32_t shell, double volume, double area)
{
    const struct zr_ring_area apex = apex_of(mesh, shell);
    const double reach = fmax(fmax(fabs(apex.first[0]), fabs(apex.first[1])), fabs(apex.first[2])) + sqrt(area);
    return fabs(volume) <= area * reach * PRECISION;
}

void zr_shells_count(const struct zr_shell_forest *forest, const struct zr_cancel *cancel, double *volumes,
                     struct zr_shells *shells)
{
    const struct zr_mesh *mesh = forest->mesh;
    if (!find_roots(forest, cancel, volumes)) return;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t shell = shell_of(forest, face);
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        if (shell != UINT32_MAX && !is_open(forest, shell)) add_face(mesh, face, shell, volumes + 2 * (size_t)shell);
    }
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        if (shell_of(forest, face) != face) continue;
        struct zr_shells *part = &shells[mesh->face_parts ? mesh->face_parts[face] : 0];
        const double volume = volumes[2 * (size_t)face], area = volumes[2 * (size_t)face + 1];
        if (is_open(forest, face) || !isfinite(volume))
            part->open++;
        else if (is_flat(mesh, face, volume, area))
            part->flat++;
        else if (volume < 0.0)
            part->inward++;
        else
            part->outward++;
    }
}
