#include "scene/unused_positions.h"

#include <stdatomic.h>
#include <string.h>

/* A fifth of a millisecond of work, more than the time to wake a thread. */
enum { INDICES_PER_RANGE = 1 << 18 };

struct marking {
    const uint32_t *indices;
    _Atomic uint8_t *used; /* per position: 1 or 0 */
};

/* Marks used positions by bytes: a bit would have to be read before it is written. */
static void mark_range(void *context, size_t begin, size_t end)
{
    const struct marking *marking = context;
    for (size_t i = begin; i < end; i++)
        atomic_store_explicit(&marking->used[marking->indices ? marking->indices[i] : i], 1, memory_order_relaxed);
}

const uint8_t *zr_used_positions(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh)
{
    struct marking marking = {.used = zr_arena_zero(arena, mesh->position_count, sizeof *marking.used)};
    const struct {
        const uint32_t *indices;
        size_t count;
    } lists[] = {{mesh->indices, mesh->face_offsets[mesh->face_count]},
                 {mesh->lines, 2 * (size_t)mesh->line_count},
                 {mesh->points, mesh->point_count}};
    for (size_t i = 0; marking.used && i < sizeof lists / sizeof *lists; i++) {
        marking.indices = lists[i].indices;
        zr_team_ranges(team, lists[i].count, INDICES_PER_RANGE, mark_range, &marking);
    }
    return (const uint8_t *)marking.used;
}

void zr_unused_positions_move(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh,
                              zr_vec4 *positions)
{
    const size_t count = mesh->position_count;
    if (count == 0) return;
    const uint8_t *used = zr_used_positions(arena, team, mesh);
    if (!used) return;
    const uint8_t *first = memchr(used, 1, count), *end = used + count;
    for (const uint8_t *at = used; first && (at = memchr(at, 0, (size_t)(end - at))); at++) {
        zr_vec4 *unused = &positions[at - used];
        const zr_vec4 *wanted = &positions[first - used];
        if (memcmp(unused, wanted, sizeof *unused) != 0) *unused = *wanted; /* no store if moved before */
    }
    zr_arena_trim(arena, (void *)(uintptr_t)used, count, 0, sizeof *used);
}
