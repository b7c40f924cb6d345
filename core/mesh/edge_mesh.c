#include "mesh/edge_mesh.h"

#include "base/cancel.h"
#include "base/run.h"
#include "base/sort.h"
#include "geometry/fans.h"
#include "geometry/triangulate.h"
#include "mesh/cap_rings.h"
#include "mesh/weld.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 14, VERTICES_PER_RANGE = 1 << 12 };

struct making {
    const struct zr_run *run;
    const struct zr_mesh *mesh;
    const uint32_t *vertices; /* by position */
    uint32_t vertex_count, triangle_count;
    uint32_t *positions, *corners, *slots, *faces;
    uint32_t *ends;    /* by vertex: end of its list; while the lists are filled, its next free entry */
    uint64_t *entries; /* the higher vertex, and the number of the side */
    uint32_t *counts;  /* by vertex: its edges, then its first edge */
    struct zr_mesh_edge *edges;
    uint32_t *sides, *side_edges;
};

static bool is_due(const struct making *m, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(m->run->cancel);
}

/* ---- vertices ---- */

static bool weld(struct making *m)
{
    const struct zr_mesh *mesh = m->mesh;
    const struct zr_mesh_extent extent = zr_mesh_extent_of(m->run->team, mesh);
    uint32_t *vertices = zr_arena_alloc(m->run->arena, mesh->position_count, sizeof *vertices);
    uint32_t *positions = zr_arena_alloc(m->run->arena, mesh->position_count, sizeof *positions);
    struct zr_arena scratch = zr_arena_open_scratch(m->run->arena);
    zr_vec4 *copy = extent.needs_copy ? zr_arena_alloc(&scratch, mesh->position_count, sizeof *copy) : NULL;
    uint64_t *room = zr_arena_alloc(&scratch, zr_weld_room(mesh->position_count), sizeof *room);
    if (vertices && positions && zr_arena_ok(&scratch)) {
        const struct zr_weld_input input = zr_weld_input_make(m->run->team, mesh, &extent, copy);
        m->vertex_count = zr_weld_make(m->run->team, m->run->cancel, &input, room, vertices);
    }
    zr_arena_close_scratch(&scratch, m->run->arena);
    if (!zr_arena_ok(m->run->arena)) return false;
    for (uint32_t p = 0, next = 0; p < mesh->position_count && next < m->vertex_count; p++)
        if (vertices[p] == next) positions[next++] = p;
    m->vertices = vertices;
    m->positions = positions;
    return true;
}

/* ---- triangles ---- */

static bool is_drawn(const struct making *m, const uint32_t vertices[3])
{
    for (int k = 0; k < 3; k++)
        if (vertices[k] == vertices[(k + 1) % 3] || m->mesh->positions[m->positions[vertices[k]]].w == 0.0f)
            return false;
    return true;
}

static void add_triangle(struct making *m, uint32_t face, const uint32_t slots[3])
{
    const size_t at = 3 * (size_t)m->triangle_count;
    uint32_t vertices[3];
    for (int k = 0; k < 3; k++)
        vertices[k] = m->vertices[m->mesh->indices[slots[k]]];
    if (!is_drawn(m, vertices)) return;
    for (size_t k = 0; k < 3; k++) {
        m->corners[at + k] = vertices[k];
        m->slots[at + k] = slots[k];
    }
    m->faces[m->triangle_count++] = face;
}

/* Scratch for faces that are no convex polygons. */
struct cutting {
    struct zr_triangulator triangulator;
    zr_vec4 *points;
    uint32_t *offsets, *slots, (*triangles)[3];
    uint32_t *groups; /* per ring of a cap */
};

/* Makes room for the largest face. */
static bool reserve(struct zr_arena *arena, const struct zr_mesh *mesh, struct cutting *cutting)
{
    uint32_t corners = 3, rings = 1;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t own = mesh->face_offsets[f + 1] - mesh->face_offsets[f], holes = zr_mesh_rings(mesh, f).count;
        if (own > corners) corners = own;
        if (holes > rings) rings = holes;
    }
    cutting->points = zr_arena_alloc(arena, corners, sizeof *cutting->points);
    cutting->slots = zr_arena_alloc(arena, corners, sizeof *cutting->slots);
    cutting->groups = zr_arena_alloc(arena, rings, sizeof *cutting->groups);
    cutting->offsets = zr_arena_alloc(arena, (size_t)rings + 1, sizeof *cutting->offsets);
    cutting->triangles = zr_arena_alloc(arena, zr_triangulate_count_max(corners, rings), sizeof *cutting->triangles);
    return zr_triangulator_reserve(arena, &cutting->triangulator, corners, rings) && zr_arena_ok(arena);
}

/* Triangulates the rings of a group: the ring that begins it, and its holes, which may come before it in the face. */
static void cut_rings(struct making *m, struct cutting *cutting, uint32_t face, uint32_t group)
{
    const struct zr_mesh *mesh = m->mesh;
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    uint32_t corners = 0, count = 0;
    for (uint32_t k = 0; k < rings.count; k++) {
        const uint32_t r = k == 0 ? group : k - (k <= group);
        if (cutting->groups[r] != group) continue;
        cutting->offsets[count++] = corners;
        for (uint32_t i = rings.offsets[r]; i < rings.offsets[r + 1]; i++, corners++) {
            cutting->points[corners] = mesh->positions[mesh->indices[i]];
            cutting->slots[corners] = i;
        }
    }
    cutting->offsets[count] = corners;
    cutting->triangulator.loops.cancel = m->run->cancel;
    const uint32_t triangles =
        zr_triangulate(&cutting->triangulator, cutting->points, cutting->offsets, count, cutting->triangles);
    for (uint32_t i = 0; i < triangles; i++) {
        const uint32_t *cut = cutting->triangles[i], *slots = cutting->slots;
        add_triangle(m, face, (const uint32_t[3]){slots[cut[0]], slots[cut[1]], slots[cut[2]]});
    }
}

static void cut_face(struct making *m, struct cutting *cutting, uint32_t face)
{
    const struct zr_rings rings = zr_mesh_rings(m->mesh, face);
    if (zr_mesh_face_is_cap(m->mesh, face))
        zr_cap_rings_group(m->mesh, &rings, m->run->cancel, cutting->groups);
    else
        memset(cutting->groups, 0, rings.count * sizeof *cutting->groups);
    for (uint32_t r = 0; r < rings.count && !zr_is_cancelled(m->run->cancel); r++)
        if (cutting->groups[r] == r) cut_rings(m, cutting, face, r);
}

/* Returns the largest number of triangles that the faces can give. */
static size_t triangles_most(const struct zr_mesh *mesh)
{
    const size_t corners = mesh->face_offsets[mesh->face_count];
    const size_t rings = mesh->face_rings ? mesh->face_rings[mesh->face_count] : mesh->face_count;
    return corners + 2 * (rings - mesh->face_count) - 2 * (size_t)mesh->face_count;
}

static bool add_faces(struct making *m, struct zr_arena *scratch, const struct zr_fans *fans)
{
    struct cutting cutting = {.points = NULL};
    for (uint32_t face = 0; face < m->mesh->face_count && !is_due(m, face); face++) {
        const uint32_t begin = m->mesh->face_offsets[face], count = m->mesh->face_offsets[face + 1] - begin;
        if (fans->is_other[face]) {
            if (!cutting.points && !reserve(scratch, m->mesh, &cutting)) return false;
            cut_face(m, &cutting, face);
            continue;
        }
        const uint32_t *slots = fans->slots + 3 * (size_t)zr_fans_first(m->mesh, face);
        for (uint32_t i = 2; i < count; i++, slots += 3)
            add_triangle(m, face, slots);
    }
    return true;
}

/* Numbers the vertices in the order of the triangles, so that files that list positions in another order give the same
 * edges in the same order. Vertices without a triangle are left out. */
static bool number_by_use(struct making *m)
{
    struct zr_arena scratch = zr_arena_open_scratch(m->run->arena);
    uint32_t *numbers = zr_arena_alloc(&scratch, m->vertex_count, sizeof *numbers);
    uint32_t *positions = zr_arena_alloc(&scratch, m->vertex_count, sizeof *positions);
    const bool ok = zr_arena_ok(&scratch);
    if (ok) {
        const size_t corners = 3 * (size_t)m->triangle_count;
        uint32_t used = 0;
        memset(numbers, 0xff, m->vertex_count * sizeof *numbers);
        for (size_t i = 0; i < corners && !is_due(m, i); i++) {
            uint32_t *number = &numbers[m->corners[i]];
            if (*number == UINT32_MAX) {
                positions[used] = m->positions[m->corners[i]];
                *number = used++;
            }
            m->corners[i] = *number;
        }
        memcpy(m->positions, positions, used * sizeof *positions);
        m->vertex_count = used;
    }
    zr_arena_close_scratch(&scratch, m->run->arena);
    return ok;
}

static bool make_triangles(struct making *m)
{
    const size_t most = triangles_most(m->mesh);
    m->corners = zr_arena_alloc(m->run->arena, most, 3 * sizeof *m->corners);
    m->slots = zr_arena_alloc(m->run->arena, most, 3 * sizeof *m->slots);
    m->faces = zr_arena_alloc(m->run->arena, most, sizeof *m->faces);
    struct zr_arena scratch = zr_arena_open_scratch(m->run->arena);
    const struct zr_run inner = zr_run_in(m->run, &scratch);
    struct zr_fans fans;
    if (zr_arena_ok(m->run->arena) && zr_fans_make(&inner, m->mesh, &fans) && !zr_is_cancelled(m->run->cancel))
        add_faces(m, &scratch, &fans);
    zr_arena_close_scratch(&scratch, m->run->arena);
    return zr_arena_ok(m->run->arena) && number_by_use(m);
}

/* ---- edges ---- */

static uint32_t lower_of(const struct making *m, uint32_t side)
{
    const uint32_t *corners = m->corners + side / 3 * 3, a = corners[side % 3], b = corners[(side % 3 + 1) % 3];
    return a < b ? a : b;
}

static uint32_t higher_of(const struct making *m, uint32_t side)
{
    const uint32_t *corners = m->corners + side / 3 * 3, a = corners[side % 3], b = corners[(side % 3 + 1) % 3];
    return a < b ? b : a;
}

/* Lists the sides at their lower vertices. ends[v] becomes the begin of v's list, ends[v + 1] its end. */
static void list_sides(struct making *m)
{
    const uint32_t sides = 3 * m->triangle_count;
    memset(m->ends, 0, ((size_t)m->vertex_count + 1) * sizeof *m->ends);
    for (uint32_t s = 0; s < sides && !is_due(m, s); s++)
        m->ends[lower_of(m, s)]++;
    for (uint32_t v = 0, sum = 0; v <= m->vertex_count; v++)
        m->ends[v] = sum += m->ends[v];
    if (zr_is_cancelled(m->run->cancel)) return;
    for (uint32_t s = sides; s-- > 0 && !is_due(m, s);)
        m->entries[--m->ends[lower_of(m, s)]] = (uint64_t)higher_of(m, s) << 32 | s;
}

static void sort_lists(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    if (zr_is_cancelled(m->run->cancel)) return;
    for (size_t v = begin; v < end; v++) {
        const uint32_t first = m->ends[v], count = m->ends[v + 1] - first;
        zr_sort_u64(m->entries + first, count);
        m->counts[v] = 0;
        for (uint32_t i = 0; i < count; i++)
            m->counts[v] += i == 0 || m->entries[first + i] >> 32 != m->entries[first + i - 1] >> 32;
    }
}

static void write_edges(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    if (zr_is_cancelled(m->run->cancel)) return;
    for (size_t v = begin; v < end; v++) {
        uint32_t edge = m->counts[v];
        for (uint32_t i = m->ends[v]; i < m->ends[v + 1]; i++) {
            const uint32_t high = (uint32_t)(m->entries[i] >> 32), side = (uint32_t)m->entries[i];
            if (i == m->ends[v] || high != m->entries[i - 1] >> 32)
                m->edges[edge++] = (struct zr_mesh_edge){(uint32_t)v, high, i};
            m->sides[i] = side;
            m->side_edges[side] = edge - 1;
        }
    }
}

static enum zr_status make_edges(struct making *m, struct zr_edge_mesh *out)
{
    const size_t sides = 3 * (size_t)m->triangle_count;
    m->sides = zr_arena_alloc(m->run->arena, sides, sizeof *m->sides);
    m->side_edges = zr_arena_alloc(m->run->arena, sides, sizeof *m->side_edges);
    m->edges = zr_arena_alloc(m->run->arena, sides + 1, sizeof *m->edges);
    struct zr_arena scratch = zr_arena_open_scratch(m->run->arena);
    m->ends = zr_arena_alloc(&scratch, (size_t)m->vertex_count + 1, sizeof *m->ends);
    m->counts = zr_arena_alloc(&scratch, m->vertex_count, sizeof *m->counts);
    m->entries = zr_arena_alloc(&scratch, sides, sizeof *m->entries);
    if (zr_arena_ok(m->run->arena) && zr_arena_ok(&scratch)) {
        list_sides(m);
        if (!zr_is_cancelled(m->run->cancel))
            zr_team_ranges(m->run->team, m->vertex_count, VERTICES_PER_RANGE, sort_lists, m);
        if (!zr_is_cancelled(m->run->cancel)) {
            for (uint32_t v = 0; v < m->vertex_count; v++) {
                const uint32_t own = m->counts[v];
                m->counts[v] = out->edge_count;
                out->edge_count += own;
            }
            zr_team_ranges(m->run->team, m->vertex_count, VERTICES_PER_RANGE, write_edges, m);
            m->edges[out->edge_count] = (struct zr_mesh_edge){.first_side = (uint32_t)sides};
        }
    }
    zr_arena_close_scratch(&scratch, m->run->arena);
    zr_arena_trim(m->run->arena, m->edges, sides + 1, (size_t)out->edge_count + 1, sizeof *m->edges);
    return zr_is_cancelled(m->run->cancel) ? ZR_CANCELLED : zr_arena_ok(m->run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- connected pieces ---- */

static uint32_t root_of(uint32_t *parents, uint32_t v)
{
    while (parents[v] != v)
        v = parents[v] = parents[parents[v]];
    return v;
}

/* Joins the triangles beside each edge of two, by a forest whose roots are the lowest triangles. */
static void join_triangles(const struct making *m, uint32_t edge_count, uint32_t *parents)
{
    for (uint32_t t = 0; t < m->triangle_count; t++)
        parents[t] = t;
    for (uint32_t e = 0; e < edge_count && !is_due(m, e); e++) {
        const uint32_t first = m->edges[e].first_side;
        if (m->edges[e + 1].first_side - first != 2) continue;
        const uint32_t a = root_of(parents, m->sides[first] / 3), b = root_of(parents, m->sides[first + 1] / 3);
        parents[a < b ? b : a] = a < b ? a : b;
    }
}

static enum zr_status make_pieces(struct making *m, struct zr_edge_mesh *out)
{
    uint32_t *pieces = zr_arena_alloc(m->run->arena, m->triangle_count, sizeof *pieces);
    struct zr_arena scratch = zr_arena_open_scratch(m->run->arena);
    uint32_t *parents = zr_arena_alloc(&scratch, m->triangle_count, sizeof *parents);
    if (pieces && parents) {
        join_triangles(m, out->edge_count, parents);
        for (uint32_t t = 0; t < m->triangle_count && !is_due(m, t); t++) {
            const uint32_t root = root_of(parents, t); /* at most t */
            pieces[t] = root == t ? out->piece_count++ : pieces[root];
        }
    }
    zr_arena_close_scratch(&scratch, m->run->arena);
    out->pieces = pieces;
    return zr_is_cancelled(m->run->cancel) ? ZR_CANCELLED : zr_arena_ok(m->run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- all steps ---- */

enum zr_status zr_edge_mesh_make(const struct zr_run *run, const struct zr_mesh *mesh, struct zr_edge_mesh *out)
{
    static const struct zr_mesh_edge no_edge = {0, 0, 0};
    struct making m = {.run = run, .mesh = mesh};
    *out = (struct zr_edge_mesh){.edges = &no_edge};
    if (mesh->face_count == 0) return ZR_OK;
    if (!weld(&m) || (m.vertex_count > 0 && !make_triangles(&m))) return ZR_NO_MEMORY;
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    enum zr_status status = make_edges(&m, out);
    if (status == ZR_OK) status = make_pieces(&m, out);
    out->vertex_count = m.vertex_count;
    out->triangle_count = m.triangle_count;
    out->positions = m.positions;
    out->corners = m.corners;
    out->slots = m.slots;
    out->faces = m.faces;
    out->edges = m.edges;
    out->sides = m.sides;
    out->side_edges = m.side_edges;
    return status;
}

bool zr_edge_is_diagonal(const struct zr_edge_mesh *mesh, uint32_t edge)
{
    const uint32_t first = mesh->edges[edge].first_side, end = mesh->edges[edge + 1].first_side;
    for (uint32_t i = first + 1; i < end; i++)
        if (mesh->faces[mesh->sides[i] / 3] == mesh->faces[mesh->sides[i - 1] / 3]) return true;
    return false;
}
