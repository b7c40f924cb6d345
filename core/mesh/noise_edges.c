#include "mesh/noise_edges.h"

#include "base/cancel.h"
#include "base/trig.h"
#include "mesh/crease_chains.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 12 };

struct finding {
    const struct zr_cancel *cancel;
    const struct zr_edge_mesh *table;
    const zr_vec4 *positions; /* by vertex, w = 1 */
    const zr_vec3 *normals;   /* by triangle */
    float cosine, diagonal;
    struct zr_steep_edges steep;
    uint32_t *edges; /* of the steep ones */
};

static bool is_due(const struct zr_cancel *cancel, uint32_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel);
}

/* ---- positions and normals ---- */

static const zr_vec4 *place_vertices(struct zr_arena *arena, const struct zr_mesh *mesh, struct finding *f)
{
    const float far = __builtin_inff();
    zr_vec4 *positions = zr_arena_alloc(arena, f->table->vertex_count, sizeof *positions);
    zr_vec3 low = {far, far, far}, high = {-far, -far, -far};
    for (uint32_t v = 0; positions && v < f->table->vertex_count && !is_due(f->cancel, v); v++) {
        const zr_vec4 p = mesh->positions[f->table->positions[v]];
        positions[v] = (zr_vec4){p.x / p.w, p.y / p.w, p.z / p.w, 1.0f};
        low = (zr_vec3){fminf(low.x, positions[v].x), fminf(low.y, positions[v].y), fminf(low.z, positions[v].z)};
        high = (zr_vec3){fmaxf(high.x, positions[v].x), fmaxf(high.y, positions[v].y), fmaxf(high.z, positions[v].z)};
    }
    const zr_vec3 extent = zr_vec3_sub(high, low);
    f->diagonal = sqrtf(zr_vec3_dot(extent, extent));
    return positions;
}

static zr_vec3 place_of(const struct finding *f, uint32_t vertex)
{
    return (zr_vec3){f->positions[vertex].x, f->positions[vertex].y, f->positions[vertex].z};
}

static const zr_vec3 *make_normals(struct zr_arena *arena, const struct finding *f)
{
    zr_vec3 *normals = zr_arena_alloc(arena, f->table->triangle_count, sizeof *normals);
    for (uint32_t t = 0; normals && t < f->table->triangle_count && !is_due(f->cancel, t); t++) {
        const uint32_t *corners = f->table->corners + 3 * (size_t)t;
        const zr_vec3 a = place_of(f, corners[0]);
        normals[t] = zr_vec3_normalize(
            zr_vec3_cross(zr_vec3_sub(place_of(f, corners[1]), a), zr_vec3_sub(place_of(f, corners[2]), a)));
    }
    return normals;
}

/* ---- steep edges ---- */

/* Returns the cosine between the triangles of an edge. ZR_NO_NEIGHBOUR: there are not two, or one polygon has both. */
static float cosine_across(const struct finding *f, uint32_t edge)
{
    const struct zr_edge_mesh *table = f->table;
    if (zr_edge_side_count(table, edge) != 2) return ZR_NO_NEIGHBOUR;
    const uint32_t *sides = table->sides + table->edges[edge].first_side, a = sides[0] / 3, b = sides[1] / 3;
    if (table->faces[a] == table->faces[b]) return ZR_NO_NEIGHBOUR;
    const float cosine = zr_vec3_dot(f->normals[a], f->normals[b]);
    return zr_side_is_upward(table, sides[0]) == zr_side_is_upward(table, sides[1]) ? -cosine : cosine;
}

static bool is_gentle(const struct finding *f, uint32_t triangle)
{
    float flattest = ZR_NO_NEIGHBOUR;
    for (size_t k = 0; k < 3; k++)
        flattest = fmaxf(flattest, cosine_across(f, f->table->side_edges[3 * (size_t)triangle + k]));
    return zr_is_gentle(flattest, f->cosine);
}

static bool is_steep(const struct finding *f, uint32_t edge)
{
    const float cosine = cosine_across(f, edge);
    return cosine < f->cosine && cosine > ZR_NO_NEIGHBOUR;
}

static void add_steep(struct finding *f, uint32_t edge)
{
    const struct zr_mesh_edge *own = &f->table->edges[edge];
    const uint32_t *sides = f->table->sides + own->first_side;
    const zr_vec3 along = zr_vec3_sub(place_of(f, own->high), place_of(f, own->low));
    f->edges[f->steep.count] = edge;
    f->steep.of[f->steep.count++] =
        (struct zr_steep_edge){.ends = {own->low, own->high},
                               .positions = {own->low, own->high},
                               .length = sqrtf(zr_vec3_dot(along, along)),
                               .has_gentle_face = is_gentle(f, sides[0] / 3) || is_gentle(f, sides[1] / 3)};
}

static bool list_steep(struct zr_arena *arena, struct finding *f)
{
    uint32_t count = 0;
    for (uint32_t e = 0; e < f->table->edge_count && !is_due(f->cancel, e); e++)
        count += is_steep(f, e);
    f->edges = zr_arena_alloc(arena, count, sizeof *f->edges);
    f->steep = (struct zr_steep_edges){.of = zr_arena_alloc(arena, count, sizeof *f->steep.of),
                                       .vertex_count = f->table->vertex_count};
    if (!zr_arena_ok(arena) || zr_is_cancelled(f->cancel)) return false;
    for (uint32_t e = 0; e < f->table->edge_count && !is_due(f->cancel, e); e++)
        if (is_steep(f, e)) add_steep(f, e);
    return count > 0;
}

/* ---- all ---- */

static bool find_steep(struct zr_arena *arena, const struct zr_mesh *mesh, struct finding *f)
{
    f->positions = place_vertices(arena, mesh, f);
    f->normals = f->positions ? make_normals(arena, f) : NULL;
    return f->normals && !zr_is_cancelled(f->cancel) && list_steep(arena, f) &&
           zr_crease_chains_find(arena, f->cancel, f->positions, f->diagonal, &f->steep);
}

const uint8_t *zr_noise_edges_find(const struct zr_run *run, const struct zr_mesh *mesh,
                                   const struct zr_edge_mesh *table, float crease_degrees)
{
    struct finding f = {.cancel = run->cancel, .table = table};
    double sine, cosine;
    if (!zr_crease_degrees_allow_noise(crease_degrees) || table->edge_count == 0) return NULL;
    zr_sine_cosine((double)crease_degrees, &sine, &cosine);
    f.cosine = (float)(cosine - 1e-6);
    uint8_t *noise = zr_arena_zero(run->arena, table->edge_count, sizeof *noise);
    if (!noise) return NULL;
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const bool any = find_steep(&scratch, mesh, &f);
    for (uint32_t i = 0; any && i < f.steep.count; i++)
        noise[f.edges[i]] = !f.steep.of[i].is_crease;
    zr_arena_close_scratch(&scratch, run->arena);
    return noise;
}
