#include "scene/unused_positions.h"

#include <stdatomic.h>

/* Less than 0.1 ms. */
enum { INDICES_A_RANGE = 1 << 15, BITS = 64 };

struct marking {
    const uint32_t *indices;
    _Atomic uint64_t *used; /* a bit a position */
};

/* Most bits are there already: threads share the lines of the caches while nobody writes them. */
static void mark_range(void *context, size_t begin, size_t end)
{
    const struct marking *marking = context;
    for (size_t i = begin; i < end; i++) {
        _Atomic uint64_t *word = &marking->used[marking->indices[i] / BITS];
        const uint64_t bit = UINT64_C(1) << marking->indices[i] % BITS;
        if (!(atomic_load_explicit(word, memory_order_relaxed) & bit))
            atomic_fetch_or_explicit(word, bit, memory_order_relaxed);
    }
}

static bool is_used(const struct marking *marking, uint32_t position)
{
    return atomic_load_explicit(&marking->used[position / BITS], memory_order_relaxed) >> position % BITS & 1u;
}

/* The first from `position` on that is used, or else is not. */
static uint32_t find(const struct marking *marking, const struct zr_mesh *mesh, uint32_t position, bool used)
{
    const uint64_t skipped = used ? 0 : UINT64_MAX;
    while (position < mesh->position_count) {
        if (position % BITS == 0 &&
            atomic_load_explicit(&marking->used[position / BITS], memory_order_relaxed) == skipped) {
            position += BITS;
            continue;
        }
        if (is_used(marking, position) == used) return position;
        position++;
    }
    return mesh->position_count;
}

void zr_unused_positions_move(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh,
                              zr_vec4 *positions)
{
    const size_t words = ((size_t)mesh->position_count + BITS - 1) / BITS;
    struct marking marking = {.used = zr_arena_zero(arena, words, sizeof *marking.used)};
    const struct {
        const uint32_t *indices;
        size_t count;
    } lists[] = {{mesh->indices, mesh->face_offsets[mesh->face_count]},
                 {mesh->lines, 2 * (size_t)mesh->line_count},
                 {mesh->points, mesh->point_count}};
    if (!marking.used) return;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        marking.indices = lists[i].indices;
        zr_team_ranges(team, lists[i].count, INDICES_A_RANGE, mark_range, &marking);
    }
    const uint32_t first = find(&marking, mesh, 0, true);
    for (uint32_t i = 0; first < mesh->position_count && i < mesh->position_count; i++) {
        i = find(&marking, mesh, i, false);
        if (i < mesh->position_count) positions[i] = positions[first];
    }
    zr_arena_trim(arena, (void *)marking.used, words, 0, sizeof *marking.used);
}
