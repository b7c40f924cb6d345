#include "geometry/shape.h"

#include <stdlib.h>

#include "base/mutant.h"
#include "geometry/cap_hull.h"
#include "geometry/clip.h"
#include "geometry/winding.h"

/* ---- edges ---- */

/* State while edges are added. */
struct trace {
    struct zr_builder *builder;
    bool clipped;
    bool is_cap; /* its edges have directions */
};

static void add_edge(struct trace *trace, const struct zr_window_vertex *a, const struct zr_window_vertex *b)
{
    struct zr_geometry *geometry = trace->builder->geometry;
    struct zr_grid_edge edge;
    if (!zr_grid_edge_make(zr_snapped_x(a), zr_snapped_y(a), zr_snapped_x(b), zr_snapped_y(b), &edge)) return;
    if (trace->is_cap)
        zr_winding_note(trace->builder, &edge, zr_snapped_y(a) < zr_snapped_y(b) ? 1 : -1);
    else if (zr_builder_reserve_shape(trace->builder, 1))
        geometry->edges[geometry->edge_count++] = edge;
}

static bool is_whole(const struct zr_builder *builder, uint32_t begin, uint32_t end)
{
    unsigned any = 0;
    for (uint32_t slot = begin; slot < end; slot++)
        any |= builder->outcodes[builder->mesh->indices[slot]];
    return any == 0;
}

static void add_whole_ring(struct trace *trace, uint32_t begin, uint32_t end)
{
    const struct zr_builder *builder = trace->builder;
    const struct zr_window_vertex *vertices = builder->geometry->vertices + builder->first_vertex;
    const uint32_t *indices = builder->mesh->indices;
    for (uint32_t slot = begin; slot < end; slot++)
        add_edge(trace, &vertices[indices[slot]], &vertices[indices[slot + 1 < end ? slot + 1 : begin]]);
}

/* Adds the edges of the visible part of one triangle of a ring's fan. */
static void add_clipped_triangle(struct trace *trace, const uint32_t corners[3])
{
    const struct zr_builder *builder = trace->builder;
    struct zr_clipped clipped;
    zr_vec4 in[3];
    struct zr_window_vertex placed[ZR_CLIP_MAX];
    unsigned all = ~0u, any = 0;
    for (int k = 0; k < 3; k++) {
        unsigned code = builder->outcodes[corners[k]];
        all &= code;
        any |= code;
        in[k] = zr_builder_clip_position(builder, corners[k]);
    }
    if (all != 0 || any & ZR_OUTCODE_UNPLACED) return;
    int count = zr_clip_triangle(in, any, NULL, &clipped);
    for (int i = 0; i < count; i++)
        if (!zr_viewport_apply(&builder->viewport, clipped.vertices[i].position, &placed[i])) return;
    for (int i = 0; i < count; i++)
        add_edge(trace, &placed[i], &placed[i + 1 < count ? i + 1 : 0]);
}

/* Adds the clipped triangles of a ring's fan. An edge shared by two of them is added twice, which cancels it. */
static void add_clipped_ring(struct trace *trace, uint32_t begin, uint32_t end)
{
    const uint32_t *indices = trace->builder->mesh->indices;
    trace->clipped = true;
    for (uint32_t slot = begin + 2; slot < end; slot++)
        add_clipped_triangle(trace, (const uint32_t[3]){indices[slot - 1], indices[slot], indices[begin]});
}

static void add_ring(struct trace *trace, uint32_t begin, uint32_t end)
{
    if (is_whole(trace->builder, begin, end))
        add_whole_ring(trace, begin, end);
    else
        add_clipped_ring(trace, begin, end);
}

/* Uses the volume between the eye and the outer ring, summed over the triangles of its fan. The whole ring counts, so
 * the result does not depend on clipping; homogeneous positions keep it correct for corners behind the eye. A ring
 * whose windings cancel out shows its front. */
bool zr_shape_shows_back(const struct zr_builder *builder, uint32_t face)
{
    struct zr_rings rings = zr_mesh_rings(builder->mesh, face);
    const uint32_t *indices = builder->mesh->indices + rings.offsets[0];
    zr_vec4 a = zr_builder_clip_position(builder, indices[0]), b = zr_builder_clip_position(builder, indices[1]);
    double volume = 0.0;
    for (uint32_t i = 2; i < rings.offsets[1] - rings.offsets[0]; i++) {
        zr_vec4 c = zr_builder_clip_position(builder, indices[i]);
        double x = (double)b.y * (double)c.w - (double)c.y * (double)b.w;
        double y = (double)b.x * (double)c.w - (double)c.x * (double)b.w;
        double w = (double)b.x * (double)c.y - (double)c.x * (double)b.y;
        volume += ((double)a.x * x - (double)a.y * y) + (double)a.w * w;
        b = c;
    }
    return volume != 0.0 && (volume < 0.0) != builder->mirrored;
}

/* Orders edges by value, so that equal ones become neighbours. */
static int compare_edges(const void *left, const void *right)
{
    const struct zr_grid_edge *a = left, *b = right;
    if (a->y0 != b->y0) return a->y0 < b->y0 ? -1 : 1;
    if (a->x0 != b->x0) return a->x0 < b->x0 ? -1 : 1;
    if (a->y1 != b->y1) return a->y1 < b->y1 ? -1 : 1;
    return a->x1 < b->x1 ? -1 : a->x1 > b->x1;
}

/* Removes pairs of equal edges, which cancel: most edges of a ring that was clipped triangle by triangle. */
static void drop_pairs(struct zr_geometry *geometry, uint32_t first)
{
    struct zr_grid_edge *edges = geometry->edges;
    uint32_t kept = first;
    if (geometry->edge_count - first < 2) return;
    qsort(edges + first, geometry->edge_count - first, sizeof *edges, compare_edges);
    for (uint32_t i = first; i < geometry->edge_count; i++) {
        if (kept > first && compare_edges(&edges[kept - 1], &edges[i]) == 0)
            kept--;
        else
            edges[kept++] = edges[i];
    }
    geometry->edge_count = kept;
}

/* ---- the shape ---- */

static struct zr_shape shape_of_edges(const struct zr_geometry *geometry, uint32_t first_edge)
{
    struct zr_shape shape = {.first_edge = first_edge, .edge_count = geometry->edge_count - first_edge};
    for (uint32_t i = first_edge; i < geometry->edge_count; i++) {
        const struct zr_grid_edge *e = &geometry->edges[i];
        int32_t low = e->x0 < e->x1 ? e->x0 : e->x1, high = e->x0 < e->x1 ? e->x1 : e->x0;
        if (i == first_edge || low < shape.min_x) shape.min_x = low;
        if (i == first_edge || high > shape.max_x) shape.max_x = high;
        if (i == first_edge || e->y0 < shape.min_y) shape.min_y = e->y0;
        if (i == first_edge || e->y1 > shape.max_y) shape.max_y = e->y1;
    }
    return shape;
}

/* Ensures room for the face's corners in one array, as zr_triangulate takes them. */
static bool reserve_cutting(struct zr_builder *builder, uint32_t corners, uint32_t rings)
{
    struct zr_cutting *cutting = &builder->cutting;
    if (!zr_triangulator_reserve(builder->run->arena, &cutting->triangulator, corners, rings)) return false;
    if (corners <= cutting->corner_room && rings <= cutting->ring_room) return true;
    if (corners > cutting->corner_room) cutting->corner_room = 2 * corners; /* doubled: the arena takes nothing back */
    if (rings > cutting->ring_room) cutting->ring_room = 2 * rings;
    size_t triangles = zr_triangulate_count_max(cutting->corner_room, cutting->ring_room);
    cutting->points = zr_arena_alloc(builder->run->arena, cutting->corner_room, sizeof *cutting->points);
    cutting->offsets = zr_arena_alloc(builder->run->arena, (size_t)cutting->ring_room + 1, sizeof *cutting->offsets);
    cutting->triangles = zr_arena_alloc(builder->run->arena, triangles, sizeof *cutting->triangles);
    return zr_arena_ok(builder->run->arena);
}

static uint32_t cut(struct zr_builder *builder, uint32_t face)
{
    const struct zr_mesh *mesh = builder->mesh;
    struct zr_cutting *cutting = &builder->cutting;
    struct zr_rings rings = zr_mesh_rings(mesh, face);
    uint32_t begin = rings.offsets[0], corners = rings.offsets[rings.count] - begin;
    if (!reserve_cutting(builder, corners, rings.count)) return 0;
    for (uint32_t i = 0; i < corners; i++)
        cutting->points[i] = mesh->positions[mesh->indices[begin + i]];
    for (uint32_t r = 0; r <= rings.count; r++)
        cutting->offsets[r] = rings.offsets[r] - begin;
    return zr_triangulate(&cutting->triangulator, cutting->points, cutting->offsets, rings.count, cutting->triangles);
}

static void place_triangles(struct zr_builder *builder, uint32_t begin, const struct zr_common *common, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t *cut = builder->cutting.triangles[i];
        zr_place_triangle(builder, (const uint32_t[3]){begin + cut[0], begin + cut[1], begin + cut[2]}, common);
    }
}

/* Places a fan over most of a cap, then the fans of all rings: any triangle has the same plane. A point with a winding
 * number other than 0 lies in one of the latter. */
static void place_fans(struct zr_builder *builder, const struct zr_rings *rings, const struct zr_common *common)
{
    uint32_t hull[ZR_CAP_HULL_MAX];
    const uint32_t around = zr_cap_hull_find(builder->mesh, rings, hull);
    for (uint32_t i = 2; i < around; i++)
        zr_place_triangle(builder, (const uint32_t[3]){hull[i - 1], hull[i], hull[0]}, common);
    for (uint32_t r = 0; r < rings->count; r++) {
        const uint32_t first = rings->offsets[r];
        if (!zr_builder_go_on(builder, rings->offsets[r + 1] - first)) return;
        for (uint32_t i = first + 2; i < rings->offsets[r + 1]; i++)
            zr_place_triangle(builder, (const uint32_t[3]){i - 1, i, first}, common);
    }
}

static void place_parts(struct zr_builder *builder, uint32_t face, const struct zr_common *common, uint32_t cuts)
{
    const struct zr_rings rings = zr_mesh_rings(builder->mesh, face);
    if (zr_mesh_face_is_cap(builder->mesh, face))
        place_fans(builder, &rings, common);
    else
        place_triangles(builder, rings.offsets[0], common, cuts);
}

void zr_shape_place(struct zr_builder *builder, uint32_t face, const struct zr_common *common)
{
    struct zr_geometry *geometry = builder->geometry;
    const bool is_cap = zr_mesh_face_is_cap(builder->mesh, face);
    struct zr_rings rings = zr_mesh_rings(builder->mesh, face);
    uint32_t first_edge = geometry->edge_count, first_triangle = geometry->primitive_count;
    struct zr_common own = *common;
    struct trace trace = {.builder = builder, .is_cap = is_cap};
    own.kind = ZR_DRAW_SHAPES;
    own.back = zr_shape_shows_back(builder, face);
    for (uint32_t r = 0; r < ZR_MUTANT(holes_filled, rings.count, 1u); r++)
        add_ring(&trace, rings.offsets[r], rings.offsets[r + 1]);
    if (is_cap && !zr_winding_add(builder, face - (builder->mesh->face_count - builder->mesh->cap_count))) return;
    if (!zr_builder_reserve_shape(builder, 0)) return;
    if (trace.clipped) drop_pairs(geometry, first_edge);
    struct zr_shape shape = shape_of_edges(geometry, first_edge);
    own.shape = geometry->shape_count;
    uint32_t cuts = is_cap ? 0 : cut(builder, face);
    own.skip_thin = true;
    place_parts(builder, face, &own, cuts);
    own.skip_thin = false;
    if (geometry->primitive_count == first_triangle) place_parts(builder, face, &own, cuts);
    shape.triangle_count = geometry->primitive_count - first_triangle;
    if (shape.triangle_count > 0)
        geometry->shapes[geometry->shape_count++] = shape;
    else
        geometry->edge_count = first_edge;
}
