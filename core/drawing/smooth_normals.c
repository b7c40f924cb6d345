#include "drawing/smooth_normals.h"

#include "base/cancel.h"

enum { ROUNDS = 2, TRIANGLES_A_RANGE = 2048 };

static const float cosine_least = 0.6f;

struct smoothing {
    const struct zr_window_mesh *mesh;
    const struct zr_cancel *cancel;
    const float (*from)[3];
    float (*to)[3];
};

static bool is_small(const struct smoothing *s, uint32_t triangle)
{
    return s->mesh->traits[triangle] & ZR_TRIANGLE_SMALL;
}

static float dot(const float a[3], const float b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* Adds the neighbour across a side, turned to the winding of the triangle. */
static void add_neighbour(const struct smoothing *s, const struct zr_drawn_instance *of, uint32_t side, float sum[3])
{
    const struct zr_edge_mesh *table = of->table;
    const uint32_t edge = table->side_edges[side], first = table->edges[edge].first_side;
    if (zr_edge_side_count(table, edge) != 2) return;
    const uint32_t other = table->sides[first] == side ? table->sides[first + 1] : table->sides[first];
    const uint32_t own = of->first_triangle + side / 3, next = of->first_triangle + other / 3;
    if (own == next || !is_small(s, next)) return;
    const float sign = zr_side_is_upward(table, side) == zr_side_is_upward(table, other) ? -1.0f : 1.0f;
    const float cosine = sign * dot(s->from[own], s->from[next]);
    if (!(cosine > cosine_least)) return;
    const float weight = sign * s->mesh->areas[next] * (cosine - cosine_least) / (1.0f - cosine_least);
    for (int k = 0; k < 3; k++)
        sum[k] += weight * s->from[next][k];
}

static void smooth(const struct smoothing *s, const struct zr_drawn_instance *of, uint32_t triangle)
{
    const float *from = s->from[triangle], area = s->mesh->areas[triangle];
    float *to = s->to[triangle], sum[3] = {area * from[0], area * from[1], area * from[2]};
    memcpy(to, from, sizeof sum);
    if (!is_small(s, triangle)) return;
    for (uint32_t k = 0; k < 3; k++)
        add_neighbour(s, of, 3 * (triangle - of->first_triangle) + k, sum);
    const float length = sqrtf(dot(sum, sum));
    for (int k = 0; length > 0.0f && k < 3; k++)
        to[k] = sum[k] / length;
}

static void smooth_range(void *context, size_t begin, size_t end)
{
    const struct smoothing *s = context;
    if (zr_is_cancelled(s->cancel)) return;
    uint32_t i = zr_drawn_instance_of(s->mesh, offsetof(struct zr_drawn_instance, first_triangle), (uint32_t)begin);
    for (uint32_t t = (uint32_t)begin; t < end; t++) {
        while (t - s->mesh->instances[i].first_triangle >= s->mesh->instances[i].table->triangle_count)
            i++;
        smooth(s, &s->mesh->instances[i], t);
    }
}

const float (*zr_smooth_normals_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                     const struct zr_window_mesh *mesh))[3]
{
    float(*rooms[ROUNDS])[3];
    struct smoothing s = {.mesh = mesh, .cancel = cancel, .from = mesh->normals};
    for (int round = 0; round < ROUNDS; round++)
        rooms[round] = zr_arena_alloc(arena, mesh->triangle_count, sizeof *rooms[round]);
    if (!zr_arena_ok(arena)) return NULL;
    for (int round = 0; round < ROUNDS; round++) {
        s.to = rooms[round];
        zr_team_ranges(team, mesh->triangle_count, TRIANGLES_A_RANGE, smooth_range, &s);
        s.from = (const float(*)[3])s.to;
    }
    return s.from;
}
