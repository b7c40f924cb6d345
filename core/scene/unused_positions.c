#include "scene/unused_positions.h"

#include <stdatomic.h>
#include <string.h>

#include "scene/degenerate_face.h"

/* A fifth of a millisecond of work, more than the time to wake a thread. */
enum { ITEMS_A_RANGE = 1 << 16 };

struct marking {
    const struct zr_mesh *mesh;
    _Atomic uint8_t *used;  /* per position: 1 or 0 */
    atomic_bool degenerate; /* some face is */
};

/* Marks used positions by bytes: a bit would have to be read before it is written. */
static void mark(const struct marking *marking, const uint32_t *indices, size_t count)
{
    for (size_t i = 0; i < count; i++)
        atomic_store_explicit(&marking->used[indices[i]], 1, memory_order_relaxed);
}

static void mark_faces(void *context, size_t begin, size_t end)
{
    const struct marking *marking = context;
    const struct zr_mesh *mesh = marking->mesh;
    for (uint32_t face = (uint32_t)begin; face < end; face++) {
        const uint32_t first = mesh->face_offsets[face];
        if (!zr_face_is_degenerate(mesh, face))
            mark(marking, mesh->indices + first, mesh->face_offsets[face + 1] - first);
    }
}

static void mark_lines(void *context, size_t begin, size_t end)
{
    const struct marking *marking = context;
    for (size_t i = begin; i < end; i++) {
        const uint32_t *line = marking->mesh->lines + 2 * i;
        if (!zr_is_same_place(marking->mesh, line[0], line[1])) mark(marking, line, 2);
    }
}

static void mark_points(void *context, size_t begin, size_t end)
{
    const struct marking *marking = context;
    mark(marking, marking->mesh->points + begin, end - begin);
}

uint8_t *zr_used_positions(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh)
{
    struct marking marking = {mesh, zr_arena_zero(arena, mesh->position_count, sizeof *marking.used), false};
    if (!marking.used) return NULL;
    zr_team_ranges(team, mesh->face_count, ITEMS_A_RANGE, mark_faces, &marking);
    zr_team_ranges(team, mesh->line_count, ITEMS_A_RANGE, mark_lines, &marking);
    zr_team_ranges(team, mesh->point_count, ITEMS_A_RANGE, mark_points, &marking);
    return (uint8_t *)marking.used;
}

static void find_degenerate(void *context, size_t begin, size_t end)
{
    struct marking *marking = context;
    bool found = false;
    for (uint32_t face = (uint32_t)begin; face < end && !found; face++)
        found = zr_face_is_degenerate(marking->mesh, face);
    if (found) atomic_store_explicit(&marking->degenerate, true, memory_order_relaxed);
}

static bool has_degenerate_faces(struct zr_team *team, const struct zr_mesh *mesh)
{
    struct marking marking = {mesh, NULL, false};
    zr_team_ranges(team, mesh->face_count, ITEMS_A_RANGE, find_degenerate, &marking);
    return atomic_load_explicit(&marking.degenerate, memory_order_relaxed);
}

void zr_unused_positions_move(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh, bool is_soup,
                              zr_vec4 *positions)
{
    const size_t count = mesh->position_count;
    if (count == 0 || (is_soup && !has_degenerate_faces(team, mesh))) return;
    uint8_t *used = zr_used_positions(arena, team, mesh);
    if (!used) return;
    const uint8_t *end = used + count, *first = memchr(used, 1, count);
    for (const uint8_t *at = used; first && (at = memchr(at, 0, (size_t)(end - at))); at++)
        positions[at - used] = positions[first - used];
    zr_arena_trim(arena, used, count, 0, sizeof *used);
}
