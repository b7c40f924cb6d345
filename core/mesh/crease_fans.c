#include "mesh/crease_fans.h"

#include <stdatomic.h>

#include "base/cancel.h"
#include "base/team.h"
#include "mesh/crease_chains.h"

enum { BENT_PER_RANGE = 256, MOST = ZR_FAN_CORNERS_MOST };

#define FADE_COSINE 0.25881905f /* of 75 degrees */

struct fans {
    const struct zr_corner_mesh *m;
    const struct zr_cancel *cancel;
    enum zr_isa isa;
    const uint32_t *bent; /* vertices */
    uint32_t bent_count;
    struct zr_steep_edges steep;
    atomic_size_t distinct; /* normals, as zr_crease_mark_equal counts them */
};

/* The corners at a vertex, and the neighbours of each in its ring. */
struct around {
    const uint32_t *slots;
    uint32_t count, vertex;
    uint32_t beside[MOST][2]; /* slots */
    uint32_t others[MOST][2]; /* their vertices */
};

/* ---- neighbours ---- */

static uint32_t vertex_at(const struct zr_corner_mesh *m, uint32_t slot)
{
    const uint32_t position = m->mesh->indices[slot];
    return m->vertices ? m->vertices[position] : position;
}

/* Returns the number of the last offset that is not above `slot`. */
static uint32_t find_offset(const uint32_t *offsets, uint32_t count, uint32_t slot)
{
    uint32_t low = 0, high = count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        *(offsets[middle] <= slot ? &low : &high) = middle;
    }
    return low;
}

/* Finds the ring of a slot. */
static void find_ring(const struct zr_mesh *mesh, uint32_t slot, uint32_t *begin, uint32_t *end)
{
    *begin = slot / 3 * 3;
    *end = *begin + 3;
    if (mesh->face_offsets[mesh->face_count] == 3 * (uint64_t)mesh->face_count) return;
    const struct zr_rings rings = zr_mesh_rings(mesh, find_offset(mesh->face_offsets, mesh->face_count, slot));
    const uint32_t ring = find_offset(rings.offsets, rings.count, slot);
    *begin = rings.offsets[ring];
    *end = rings.offsets[ring + 1];
}

static void look_around(const struct zr_corner_mesh *m, uint32_t vertex, struct around *out)
{
    const uint32_t first = vertex == 0 ? 0 : m->of.ends[vertex - 1];
    out->slots = m->of.slots + first;
    out->count = m->of.ends[vertex] - first;
    out->vertex = vertex;
    for (uint32_t i = 0; i < out->count; i++) {
        uint32_t begin, end, slot = out->slots[i];
        find_ring(m->mesh, slot, &begin, &end);
        out->beside[i][0] = slot == begin ? end - 1 : slot - 1;
        out->beside[i][1] = slot + 1 == end ? begin : slot + 1;
        for (int k = 0; k < 2; k++)
            out->others[i][k] = vertex_at(m, out->beside[i][k]);
    }
}

static zr_vec3 normal_at(const struct zr_corner_mesh *m, uint32_t slot)
{
    const zr_vec4 *corner = &m->corners[slot];
    return (zr_vec3){corner->x, corner->y, corner->z};
}

static bool has_normal(zr_vec3 n)
{
    return n.x != 0.0f || n.y != 0.0f || n.z != 0.0f;
}

/* Returns the corner whose face shares the edge to `other` with the face of corner i; out->count if no face does, or
 * several do. */
static uint32_t across(const struct around *around, uint32_t i, uint32_t other)
{
    uint32_t found = around->count;
    for (uint32_t j = 0; j < around->count; j++) {
        if (j == i || (around->others[j][0] != other && around->others[j][1] != other)) continue;
        if (found < around->count) return around->count;
        found = j;
    }
    return found;
}

static float cosine_between(const struct zr_corner_mesh *m, const struct around *around, uint32_t i, uint32_t j)
{
    return zr_vec3_dot(normal_at(m, around->slots[i]), normal_at(m, around->slots[j]));
}

/* Returns the cosine across the other edge of corner i than that to `other`. */
static float cosine_across(const struct zr_corner_mesh *m, const struct around *around, uint32_t i, uint32_t other)
{
    const uint32_t side = around->others[i][0] == other, j = across(around, i, around->others[i][side]);
    return j < around->count ? cosine_between(m, around, i, j) : ZR_NO_NEIGHBOUR;
}

static float length_between(const struct zr_corner_mesh *m, uint32_t slot, uint32_t other)
{
    const zr_vec4 *a = &m->mesh->positions[m->mesh->indices[slot]], *b = &m->mesh->positions[m->mesh->indices[other]];
    const zr_vec3 d = {b->x - a->x, b->y - a->y, b->z - a->z};
    return sqrtf(zr_vec3_dot(d, d));
}

/* ---- steep edges ---- */

/* True if the face of corner i is gentle at the other end of its edge to `slot`. */
static bool is_gentle_at(const struct zr_corner_mesh *m, uint32_t vertex, uint32_t slot, float at_vertex)
{
    struct around far;
    uint32_t i = 0;
    look_around(m, vertex_at(m, slot), &far);
    while (i + 1 < far.count && far.slots[i] != slot)
        i++;
    return zr_is_gentle(fmaxf(at_vertex, cosine_across(m, &far, i, vertex)), m->cosine);
}

/* True if the face of corner i is gentle beside its edge to neighbour `side`. */
static bool is_gentle(const struct zr_corner_mesh *m, const struct around *around, uint32_t i, uint32_t other)
{
    const uint32_t side = around->others[i][1] == other;
    return is_gentle_at(m, around->vertex, around->beside[i][side], cosine_across(m, around, i, other));
}

/* Writes the steep edge of corner i to neighbour `side`. False if there is none; each edge is found once. */
static bool find_steep(const struct zr_corner_mesh *m, const struct around *around, uint32_t i, int side,
                       struct zr_steep_edge *out)
{
    const uint32_t other = around->others[i][side], slot = around->beside[i][side];
    if (other <= around->vertex || !m->of.bent[other]) return false;
    const uint32_t j = across(around, i, other);
    if (j == around->count || j < i || !(cosine_between(m, around, i, j) < m->cosine)) return false;
    if (!has_normal(normal_at(m, around->slots[i])) || !has_normal(normal_at(m, around->slots[j]))) return false;
    *out = (struct zr_steep_edge){.ends = {around->vertex, other},
                                  .positions = {m->mesh->indices[around->slots[i]], m->mesh->indices[slot]},
                                  .length = length_between(m, around->slots[i], slot)};
    if (out->length < ZR_SMALL_EDGE * m->diagonal)
        out->has_gentle_face = is_gentle(m, around, i, other) || is_gentle(m, around, j, other);
    return true;
}

static void list_steep(struct fans *f)
{
    struct around around;
    for (uint32_t b = 0; b < f->bent_count && !zr_is_cancelled(f->cancel); b++) {
        look_around(f->m, f->bent[b], &around);
        for (uint32_t i = 0; i < around.count; i++)
            for (int side = 0; side < 2; side++)
                f->steep.count += find_steep(f->m, &around, i, side, &f->steep.of[f->steep.count]);
    }
}

/* Returns true if the edge from a vertex to another is steep, but no crease. */
static bool is_noise(const struct zr_steep_edges *steep, uint32_t vertex, uint32_t other)
{
    for (uint32_t k = steep->starts[vertex]; k < steep->starts[vertex + 1]; k++) {
        const struct zr_steep_edge *edge = &steep->of[steep->listed[k] / 2];
        if (edge->ends[1 - steep->listed[k] % 2] == other) return !edge->is_crease;
    }
    return false;
}

/* ---- fans of a vertex ---- */

static bool are_joined(const struct fans *f, const struct around *around, uint32_t i, uint32_t j)
{
    for (int k = 0; k < 4; k++) {
        const uint32_t other = around->others[i][k & 1];
        if (other != around->others[j][k >> 1]) continue;
        if (!(cosine_between(f->m, around, i, j) < f->m->cosine) || is_noise(&f->steep, around->vertex, other))
            return true;
    }
    return false;
}

/* Sets the number of each corner's fan: its lowest corner. */
static void find_fans(const struct fans *f, const struct around *around, uint32_t fans[MOST])
{
    for (uint32_t i = 0; i < around->count; i++) {
        fans[i] = i;
        for (uint32_t j = 0; j < i; j++) {
            if (fans[j] == fans[i] || !are_joined(f, around, i, j)) continue;
            const uint32_t low = fans[j] < fans[i] ? fans[j] : fans[i], high = fans[j] < fans[i] ? fans[i] : fans[j];
            for (uint32_t k = 0; k <= i; k++)
                if (fans[k] == high) fans[k] = low;
        }
    }
}

static float weight_of(const struct fans *f, float cosine, bool is_of_fan)
{
    if (cosine >= f->m->cosine) return 1.0f;
    return is_of_fan ? fmaxf((cosine - FADE_COSINE) / (f->m->cosine - FADE_COSINE), 0.0f) : 0.0f;
}

static zr_vec4 sum_fan(const struct fans *f, const struct around *around, const uint32_t fans[MOST], uint32_t i)
{
    zr_vec3 sum = {0, 0, 0};
    const zr_vec3 own = normal_at(f->m, around->slots[i]);
    for (uint32_t j = 0; j < around->count; j++) {
        const zr_vec3 n = normal_at(f->m, around->slots[j]);
        const float weight = has_normal(own) ? weight_of(f, zr_vec3_dot(own, n), fans[i] == fans[j]) : 1.0f;
        sum = zr_vec3_add(sum, zr_vec3_scale(n, weight * f->m->corners[around->slots[j]].w));
    }
    const zr_vec3 unit = zr_vec3_normalize(sum), chosen = zr_vec3_dot(unit, unit) > 0.5f ? unit : own;
    return (zr_vec4){chosen.x, chosen.y, chosen.z, 0};
}

static size_t put_fans(const struct fans *f, const struct around *around)
{
    uint32_t fans[MOST];
    zr_vec4 normals[MOST];
    find_fans(f, around, fans);
    for (uint32_t i = 0; i < around->count; i++)
        normals[i] = sum_fan(f, around, fans, i);
    for (uint32_t i = 0; i < around->count; i++)
        f->m->corners[around->slots[i]] = normals[i];
    return zr_crease_mark_equal(around->slots, around->count, f->m->corners);
}

/* True if all edges of a vertex are small. */
static bool is_fine(const struct zr_corner_mesh *m, const struct around *around)
{
    const float least = ZR_SMALL_EDGE * m->diagonal;
    for (uint32_t i = 0; i < around->count; i++)
        for (int k = 0; k < 2; k++)
            if (!(length_between(m, around->slots[i], around->beside[i][k]) < least)) return false;
    return true;
}

static void put_range(void *context, size_t begin, size_t end)
{
    struct fans *f = context;
    size_t distinct = 0;
    const struct zr_vertex_corners plain = {f->m->of.ends, f->m->of.slots, NULL};
    struct around around;
    for (size_t b = begin; b < end && !zr_is_cancelled(f->cancel); b++) {
        const uint32_t vertex = f->bent[b];
        look_around(f->m, vertex, &around);
        if (f->steep.listed && is_fine(f->m, &around))
            distinct += put_fans(f, &around);
        else
            distinct += zr_crease_sums_of(f->isa)(&plain, vertex, (size_t)vertex + 1, f->m->cosine, f->m->corners);
    }
    atomic_fetch_add_explicit(&f->distinct, distinct, memory_order_relaxed);
}

/* ---- all ---- */

/* Lists the bent vertices. Returns the number of their corners. */
static size_t list_bent(struct fans *f, uint32_t *bent, bool *any_fine)
{
    size_t corners = 0;
    struct around around;
    for (uint32_t v = 0; v < f->m->vertex_count; v++) {
        if (!f->m->of.bent[v]) continue;
        bent[f->bent_count++] = v;
        corners += f->m->of.ends[v] - (v == 0 ? 0 : f->m->of.ends[v - 1]);
        if (*any_fine || zr_is_cancelled(f->cancel)) continue;
        look_around(f->m, v, &around);
        *any_fine = is_fine(f->m, &around);
    }
    f->bent = bent;
    return corners;
}

static void find_creases(struct zr_arena *arena, struct fans *f, size_t corners)
{
    f->steep = (struct zr_steep_edges){.vertex_count = f->m->vertex_count,
                                       .of = zr_arena_alloc(arena, corners, sizeof *f->steep.of)};
    if (!f->steep.of) return;
    list_steep(f);
    zr_arena_trim(arena, f->steep.of, corners, f->steep.count, sizeof *f->steep.of);
    zr_crease_chains_find(arena, f->cancel, f->m->mesh->positions, f->m->diagonal, &f->steep);
}

size_t zr_crease_fans_apply(const struct zr_run *run, const struct zr_corner_mesh *mesh)
{
    struct fans f = {.m = mesh, .cancel = run->cancel, .isa = zr_team_isa(run->team)};
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    uint32_t *bent = zr_arena_alloc(&scratch, mesh->vertex_count, sizeof *bent);
    bool any_fine = false;
    const size_t corners = bent ? list_bent(&f, bent, &any_fine) : 0;
    if (any_fine) find_creases(&scratch, &f, corners);
    if (zr_arena_ok(&scratch)) zr_team_ranges(run->team, f.bent_count, BENT_PER_RANGE, put_range, &f);
    zr_arena_close_scratch(&scratch, run->arena);
    return f.distinct;
}
