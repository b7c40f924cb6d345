#include "geometry/builder.h"

/* How many an array of `room` grows to for `more` beside `count`: at least by
 * half, so that growth costs a constant share. 0: too many. */
static uint64_t grown_room(uint32_t room, uint32_t count, uint64_t more)
{
    uint64_t wanted = (uint64_t)count + more;
    if (wanted > ZR_GEOMETRY_MAX) return 0;
    uint64_t grown = (uint64_t)room + room / 2;
    return grown < wanted ? wanted : grown < ZR_GEOMETRY_MAX ? grown : ZR_GEOMETRY_MAX;
}

static bool reserve(struct zr_arena *arena, void **array, uint32_t *room, uint32_t count, uint64_t more, size_t size)
{
    if (*room - count >= more) return true;
    uint64_t wanted = grown_room(*room, count, more);
    void *grown = wanted > 0 ? zr_arena_grow(arena, *array, count, wanted, size) : NULL;
    if (!grown) {
        arena->failed = true;
        return false;
    }
    *array = grown;
    *room = (uint32_t)wanted;
    return true;
}

bool zr_builder_reserve(struct zr_builder *builder, uint64_t vertices, uint64_t colors, uint64_t triangles)
{
    struct zr_geometry *g = builder->geometry;
    struct zr_arena *arena = builder->arena;
    void *vertex_array = g->vertices, *front = g->front_colors, *back = g->back_colors, *triangle_array = g->triangles;
    uint32_t back_room = builder->color_room;
    bool ok = reserve(arena, &vertex_array, &builder->vertex_room, g->vertex_count, vertices, sizeof *g->vertices);
    ok = ok && reserve(arena, &front, &builder->color_room, g->color_count, colors, sizeof *g->front_colors);
    if (builder->separate_backs)
        ok = ok && reserve(arena, &back, &back_room, g->color_count, colors, sizeof *g->back_colors);
    ok = ok &&
         reserve(arena, &triangle_array, &builder->triangle_room, g->triangle_count, triangles, sizeof *g->triangles);
    if (!ok) return false;
    g->vertices = vertex_array;
    g->front_colors = front;
    g->back_colors = builder->separate_backs ? back : front;
    g->triangles = triangle_array;
    return true;
}

bool zr_builder_reserve_shape(struct zr_builder *builder, uint64_t edges)
{
    struct zr_geometry *g = builder->geometry;
    void *edge_array = g->edges, *shapes = g->shapes;
    if (g->shape_count >= ZR_SHAPE_MASK - 1) builder->arena->failed = true;
    if (!reserve(builder->arena, &edge_array, &builder->edge_room, g->edge_count, edges, sizeof *g->edges))
        return false;
    g->edges = edge_array;
    if (!reserve(builder->arena, &shapes, &builder->shape_room, g->shape_count, 1, sizeof *g->shapes)) return false;
    g->shapes = shapes;
    return true;
}

bool zr_builder_reserve_cut(struct zr_builder *builder)
{
    struct zr_sources *sources = &builder->geometry->sources;
    void *cuts = sources->cuts;
    if (!reserve(builder->arena, &cuts, &builder->cut_room, sources->cut_count, 1, sizeof *sources->cuts)) return false;
    sources->cuts = cuts;
    return true;
}

uint32_t zr_builder_color(const struct zr_builder *builder, uint32_t face, bool smooth, uint32_t slot)
{
    const struct zr_mesh *mesh = builder->mesh;
    if (builder->layout == ZR_COLOR_PER_FACE) return builder->first_color + face;
    if (builder->layout == ZR_COLOR_PER_VERTEX) return builder->first_color + mesh->indices[slot];
    return builder->first_color + (smooth ? slot : mesh->face_offsets[face]);
}

bool zr_builder_append_clipped(struct zr_builder *builder, const struct zr_clip_vertex *corners, int count, bool flat,
                               bool placed[ZR_CLIP_MAX])
{
    struct zr_geometry *geometry = builder->geometry;
    if (!zr_builder_reserve(builder, (uint64_t)count, flat ? 0 : (uint64_t)count, 0)) return false;
    for (int i = 0; i < count; i++) {
        struct zr_window_vertex *vertex = &geometry->vertices[geometry->vertex_count++];
        placed[i] = zr_viewport_apply(&builder->viewport, corners[i].position, vertex);
        vertex->eye_z = corners[i].eye_z;
        vertex->eye_w = corners[i].eye_w;
        if (flat) continue;
        geometry->back_colors[geometry->color_count] = corners[i].back;
        geometry->front_colors[geometry->color_count++] = corners[i].front;
    }
    return true;
}
