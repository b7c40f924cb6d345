#include "mesh/features/facets.h"

#include <string.h>

#include "base/sort.h"

enum { SIDES_PER_LOOK = 1 << 12 };

static const double FLAT = 8.7266e-4; /* sine of 0.05 degrees */
static const double FLAT_MOST = 0.05; /* however thin a triangle is */

struct making {
    struct zr_feature_work *work;
    const struct zr_surface *surface;
    uint32_t (*neighbours)[3];
    uint32_t *parents;
    zr_dvec3 *areas;   /* per triangle: area vector, twice as long as the area */
    double *lengths;   /* of `areas` */
    double *longest;   /* per triangle: length of its longest side */
    uint32_t *ends;    /* per place */
    uint64_t *entries; /* per side: its higher place, and its number */
    uint32_t border_count;
};

static bool is_due(const struct making *m, size_t i)
{
    return i % SIDES_PER_LOOK == 0 && !zr_feature_has_steps(m->work, SIDES_PER_LOOK);
}

/* ---- neighbours ---- */

static uint32_t lower_of(const struct zr_surface *surface, uint32_t side)
{
    const uint32_t *corners = surface->corners[side / 3], a = corners[side % 3], b = corners[(side % 3 + 1) % 3];
    return a < b ? a : b;
}

static uint32_t higher_of(const struct zr_surface *surface, uint32_t side)
{
    const uint32_t *corners = surface->corners[side / 3], a = corners[side % 3], b = corners[(side % 3 + 1) % 3];
    return a < b ? b : a;
}

static bool is_upward(const struct zr_surface *surface, uint32_t side)
{
    return surface->corners[side / 3][side % 3] == lower_of(surface, side);
}

/* Marks a side whose edge no other triangle uses, until the borders are listed. */
#define BORDER (UINT32_MAX - 1)

/* Pairs the sides in a list of entries, which is sorted. */
static void pair_sides(struct making *m, const uint64_t *entries, uint32_t count)
{
    for (uint32_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && entries[next] >> 32 == entries[i] >> 32; next++) {
        }
        const uint32_t a = (uint32_t)entries[i], b = (uint32_t)entries[next - 1];
        if (next - i == 1) {
            m->neighbours[a / 3][a % 3] = BORDER;
            m->border_count++;
        }
        if (next - i != 2 || is_upward(m->surface, a) == is_upward(m->surface, b)) continue;
        m->neighbours[a / 3][a % 3] = b / 3;
        m->neighbours[b / 3][b % 3] = a / 3;
    }
}

static bool find_neighbours(struct making *m)
{
    const struct zr_surface *surface = m->surface;
    const uint32_t sides = 3 * surface->triangle_count;
    memset(m->neighbours, 0xff, surface->triangle_count * sizeof *m->neighbours);
    memset(m->ends, 0, ((size_t)surface->place_count + 1) * sizeof *m->ends);
    for (uint32_t s = 0; s < sides; s++) {
        if (is_due(m, s)) return false;
        m->ends[lower_of(surface, s)]++;
    }
    for (uint32_t v = 0, sum = 0; v <= surface->place_count; v++)
        m->ends[v] = sum += m->ends[v];
    for (uint32_t s = sides; s-- > 0;) {
        if (is_due(m, s)) return false;
        m->entries[--m->ends[lower_of(surface, s)]] = (uint64_t)higher_of(surface, s) << 32 | s;
    }
    for (uint32_t v = 0; v < surface->place_count; v++) {
        const uint32_t first = m->ends[v], count = m->ends[v + 1] - first;
        if (is_due(m, v)) return false;
        zr_sort_u64(m->entries + first, count);
        pair_sides(m, m->entries + first, count);
    }
    return true;
}

/* Lists the borders, in the order of sides. */
static bool list_borders(struct zr_arena *arena, struct zr_arena *scratch, const struct making *m,
                         struct zr_facets *out)
{
    uint32_t count = 0;
    uint32_t *borders = zr_arena_alloc_beside(arena, scratch, m->border_count, sizeof *borders);
    if (!borders) return false;
    for (uint32_t s = 0; s < 3 * m->surface->triangle_count; s++) {
        if (is_due(m, s)) return false;
        if (m->neighbours[s / 3][s % 3] != BORDER) continue;
        m->neighbours[s / 3][s % 3] = ZR_NO_FACET;
        borders[count++] = s;
    }
    out->borders = borders;
    out->border_count = count;
    return true;
}

/* ---- joining ---- */

static uint32_t root_of(uint32_t *parents, uint32_t t)
{
    while (parents[t] != t)
        t = parents[t] = parents[parents[t]];
    return t;
}

static void join(const struct making *m, uint32_t t, uint32_t u)
{
    const uint32_t a = root_of(m->parents, t), b = root_of(m->parents, u);
    m->parents[a < b ? b : a] = a < b ? a : b;
}

static void measure(const struct making *m, uint32_t t)
{
    const struct zr_surface *surface = m->surface;
    const zr_dvec3 a = surface->places[surface->corners[t][0]], b = surface->places[surface->corners[t][1]],
                   c = surface->places[surface->corners[t][2]];
    const zr_dvec3 ab = zr_dvec3_sub(b, a), ac = zr_dvec3_sub(c, a), bc = zr_dvec3_sub(c, b);
    m->areas[t] = zr_dvec3_cross(ab, ac);
    m->lengths[t] = sqrt(zr_dvec3_dot(m->areas[t], m->areas[t]));
    m->longest[t] = sqrt(zr_most_of(zr_dvec3_dot(ab, ab), zr_most_of(zr_dvec3_dot(ac, ac), zr_dvec3_dot(bc, bc))));
}

/* A triangle lower than rounding errors has no direction. */
static bool has_area(const struct making *m, uint32_t t)
{
    return m->lengths[t] > m->surface->noise * m->longest[t];
}

static void join_thin(const struct making *m, uint32_t t)
{
    const struct zr_surface *surface = m->surface;
    double most = -1.0;
    uint32_t to = t;
    for (int k = 0; k < 3; k++) {
        const zr_dvec3 side =
            zr_dvec3_sub(surface->places[surface->corners[t][(k + 1) % 3]], surface->places[surface->corners[t][k]]);
        const double length = zr_dvec3_dot(side, side);
        if (m->neighbours[t][k] == ZR_NO_FACET || length <= most) continue;
        most = length;
        to = m->neighbours[t][k];
    }
    join(m, t, to);
}

static bool are_flat(const struct making *m, uint32_t t, uint32_t u)
{
    const double product = m->lengths[t] * m->lengths[u];
    const double low = zr_least_of(m->lengths[t] / m->longest[t], m->lengths[u] / m->longest[u]);
    const double sine = zr_least_of(FLAT + m->surface->noise / low, FLAT_MOST);
    const zr_dvec3 cross = zr_dvec3_cross(m->areas[t], m->areas[u]);
    return zr_dvec3_dot(m->areas[t], m->areas[u]) > 0.0 &&
           zr_dvec3_dot(cross, cross) <= (sine * product) * (sine * product);
}

static bool join_triangles(const struct making *m)
{
    const uint32_t count = m->surface->triangle_count;
    for (uint32_t t = 0; t < count; t++) {
        if (is_due(m, t)) return false;
        m->parents[t] = t;
        measure(m, t);
    }
    for (uint32_t t = 0; t < count; t++) {
        if (is_due(m, t)) return false;
        if (!has_area(m, t)) {
            join_thin(m, t);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const uint32_t u = m->neighbours[t][k];
            if (u != ZR_NO_FACET && u > t && has_area(m, u) && are_flat(m, t, u)) join(m, t, u);
        }
    }
    return true;
}

/* ---- facets ---- */

/* Numbers the facets and lists their triangles. */
static bool list(const struct making *m, uint32_t *of_triangle, uint32_t *begins, uint32_t *triangles, uint32_t *count)
{
    const uint32_t all = m->surface->triangle_count;
    *count = 0;
    for (uint32_t t = 0; t < all; t++) {
        if (is_due(m, t)) return false;
        const uint32_t root = root_of(m->parents, t); /* at most t */
        if (root == t) begins[(*count)++] = 0;
        of_triangle[t] = root == t ? *count - 1 : of_triangle[root];
        begins[of_triangle[t]]++;
    }
    begins[*count] = 0;
    for (uint32_t f = 0, sum = 0; f <= *count; f++)
        begins[f] = sum += begins[f];
    for (uint32_t t = all; t-- > 0;) {
        if (is_due(m, t)) return false;
        triangles[--begins[of_triangle[t]]] = t;
    }
    return true;
}

static bool sum_areas(const struct making *m, const struct zr_facets *facets, zr_dvec3 *normals, double *areas)
{
    for (uint32_t f = 0; f < facets->count; f++) {
        zr_dvec3 sum = {0, 0, 0};
        for (uint32_t i = facets->begins[f]; i < facets->begins[f + 1]; i++) {
            if (is_due(m, i)) return false;
            sum = zr_dvec3_add_scaled(sum, m->areas[facets->triangles[i]], 1.0);
        }
        const double length = sqrt(zr_dvec3_dot(sum, sum)), scale = length > 0.0 ? 1.0 / length : 0.0;
        normals[f] = (zr_dvec3){sum.x * scale, sum.y * scale, sum.z * scale};
        areas[f] = 0.5 * length;
    }
    return true;
}

bool zr_facets_make(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_surface *surface,
                    struct zr_facets *out)
{
    const size_t count = surface->triangle_count;
    uint32_t *of_triangle = zr_arena_alloc(arena, count, sizeof *of_triangle),
             *begins = zr_arena_alloc(arena, count + 1, sizeof *begins),
             *triangles = zr_arena_alloc(arena, count, sizeof *triangles);
    zr_dvec3 *normals = zr_arena_alloc(arena, count, sizeof *normals);
    double *areas = zr_arena_alloc(arena, count, sizeof *areas);
    struct making m = {.work = work, .surface = surface};
    m.neighbours = zr_arena_alloc(arena, count, sizeof *m.neighbours);
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    m.parents = zr_arena_alloc(&scratch, count, sizeof *m.parents);
    m.areas = zr_arena_alloc(&scratch, count, sizeof *m.areas);
    m.lengths = zr_arena_alloc(&scratch, count, sizeof *m.lengths);
    m.longest = zr_arena_alloc(&scratch, count, sizeof *m.longest);
    m.ends = zr_arena_alloc(&scratch, (size_t)surface->place_count + 1, sizeof *m.ends);
    m.entries = zr_arena_alloc(&scratch, 3 * count, sizeof *m.entries);
    *out = (struct zr_facets){.surface = surface,
                              .neighbours = (const uint32_t(*)[3])m.neighbours,
                              .of_triangle = of_triangle,
                              .begins = begins,
                              .triangles = triangles,
                              .normals = normals,
                              .areas = areas};
    const bool ok = zr_arena_ok(arena) && zr_arena_ok(&scratch) && find_neighbours(&m) &&
                    list_borders(arena, &scratch, &m, out) && join_triangles(&m) &&
                    list(&m, of_triangle, begins, triangles, &out->count) && sum_areas(&m, out, normals, areas);
    zr_arena_close_scratch(&scratch, arena);
    return ok;
}
