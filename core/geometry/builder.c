#include "geometry/builder.h"

#include "base/rgba.h"

/* Looks are so much work apart: some milliseconds, were all of it corners of faces that are cut, squared. */
enum { WORK_A_LOOK = 1 << 20 };

bool zr_builder_go_on(struct zr_builder *builder, uint64_t work)
{
    builder->unlooked += work;
    if (builder->unlooked < WORK_A_LOOK) return true;
    builder->unlooked = 0;
    return !zr_is_cancelled(builder->cancel);
}

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
    void *eyes = g->eyes, *points = g->points, *surfaces = g->surfaces;
    uint32_t back_room = builder->color_room, eye_room = builder->vertex_room, point_room = builder->vertex_room;
    uint32_t surface_room = builder->triangle_room;
    bool ok = reserve(arena, &vertex_array, &builder->vertex_room, g->vertex_count, vertices, sizeof *g->vertices);
    ok = ok && reserve(arena, &eyes, &eye_room, g->vertex_count, vertices, sizeof *g->eyes);
    if (builder->points) ok = ok && reserve(arena, &points, &point_room, g->vertex_count, vertices, sizeof *g->points);
    if (builder->some_normals)
        ok = ok && reserve(arena, &surfaces, &surface_room, g->triangle_count, triangles, sizeof *g->surfaces);
    ok = ok && reserve(arena, &front, &builder->color_room, g->color_count, colors, sizeof *g->front_colors);
    if (builder->separate_backs)
        ok = ok && reserve(arena, &back, &back_room, g->color_count, colors, sizeof *g->back_colors);
    ok = ok &&
         reserve(arena, &triangle_array, &builder->triangle_room, g->triangle_count, triangles, sizeof *g->triangles);
    if (!ok) return false;
    g->vertices = vertex_array;
    g->eyes = eyes;
    g->points = points;
    g->surfaces = surfaces;
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

bool zr_builder_reserve_normals(struct zr_builder *builder, uint64_t more)
{
    struct zr_geometry *g = builder->geometry;
    void *normals = g->normals;
    if (!reserve(builder->arena, &normals, &builder->normal_room, g->normal_count, more + 1, sizeof *g->normals))
        return false;
    g->normals = normals;
    if (g->normal_count == 0) g->normals[g->normal_count++] = (zr_vec4){0, 0, 0, 0};
    return true;
}

bool zr_builder_add_batch(struct zr_builder *builder, struct zr_batch batch)
{
    struct zr_geometry *g = builder->geometry;
    void *batches = g->batches;
    if (batch.count == 0) return true;
    if (batch.count > ZR_GEOMETRY_MAX - builder->next_number) {
        builder->arena->failed = true;
        return false;
    }
    if (!reserve(builder->arena, &batches, &builder->batch_room, g->batch_count, 1, sizeof *g->batches)) return false;
    g->batches = batches;
    batch.first = builder->next_number;
    batch.instance = builder->instance;
    builder->next_number += batch.count;
    g->batches[g->batch_count++] = batch;
    return true;
}

static bool is_plain(const struct zr_triangle *record)
{
    return !record->line && !record->pushed && record->shape == 0;
}

bool zr_builder_add_written(struct zr_builder *builder)
{
    const struct zr_geometry *g = builder->geometry;
    while (builder->batched_records < g->triangle_count) {
        uint32_t begin = builder->batched_records, end = begin + 1;
        bool plain = is_plain(&g->triangles[begin]);
        while (end < g->triangle_count && is_plain(&g->triangles[end]) == plain)
            end++;
        struct zr_batch batch = {.count = end - begin, .written = true, .plain = plain, .first_record = begin};
        if (!zr_builder_add_batch(builder, batch)) return false;
        builder->batched_records = end;
    }
    return true;
}

/* Where zr_builder_color will look, as if those of all faces were there. */
static bool own_packed(struct zr_builder *builder, uint32_t face)
{
    struct zr_geometry *g = builder->geometry;
    const struct zr_colors *colors = &builder->colors;
    if (!zr_builder_reserve(builder, 0, 1, 0)) return false;
    g->front_colors[g->color_count] = zr_rgba_floats(colors->packed[face]);
    g->back_colors[g->color_count] = zr_rgba_floats(colors->packed[colors->sided ? colors->count + face : face]);
    builder->first_color = g->color_count++ - face;
    return true;
}

bool zr_builder_own_colors(struct zr_builder *builder, uint32_t face)
{
    if (builder->colors.packed) return own_packed(builder, face);
    return !builder->colors.given || zr_builder_make_colors(builder);
}

bool zr_builder_make_colors(struct zr_builder *builder)
{
    struct zr_geometry *g = builder->geometry;
    uint32_t count = zr_colors_count(builder->scene, builder->mesh);
    if (count == 0) return true; /* a mesh of lines alone: there may be no arrays yet */
    if (!zr_builder_reserve(builder, 0, count, 0)) return false;
    builder->colors =
        zr_colors_make(builder->arena, builder->team, builder->cancel, builder->scene, builder->mesh, builder->lighting,
                       &builder->object_to_eye, &builder->vertex_normals[builder->mesh - builder->scene->meshes],
                       g->front_colors + g->color_count, g->back_colors + g->color_count);
    builder->first_color = g->color_count;
    g->color_count += count;
    return zr_arena_ok(builder->arena);
}

uint32_t zr_builder_color(const struct zr_builder *builder, uint32_t face, bool smooth, uint32_t slot)
{
    const struct zr_mesh *mesh = builder->mesh;
    if (builder->uncolored) return 0;
    if (builder->colors.layout == ZR_COLOR_PER_FACE) return builder->first_color + face;
    if (builder->colors.layout == ZR_COLOR_PER_VERTEX) return builder->first_color + mesh->indices[slot];
    return builder->first_color + (smooth ? slot : mesh->face_offsets[face]);
}

/* What varies over the corners, cut as they were, to `out`, vertex by vertex. values[]: those of the corners. */
static void append_values(const struct zr_clipped *clipped, zr_vec4 values[ZR_CLIP_VALUES], zr_vec4 *out)
{
    zr_clip_replay(clipped, values);
    for (int i = 0; i < clipped->count; i++)
        out[i] = values[clipped->vertices[i].id];
}

static void append_colors(struct zr_geometry *geometry, const struct zr_clipped *clipped,
                          const struct zr_builder_corner *corners)
{
    zr_vec4 *const arrays[2] = {geometry->front_colors, geometry->back_colors};
    for (int side = 0; side < (arrays[0] == arrays[1] ? 1 : 2); side++) {
        zr_vec4 values[ZR_CLIP_VALUES];
        for (int k = 0; k < clipped->corners; k++)
            values[k] = arrays[side][corners[k].color];
        append_values(clipped, values, arrays[side] + geometry->color_count);
    }
    geometry->color_count += (uint32_t)clipped->count;
}

static void append_normals(struct zr_geometry *geometry, const struct zr_clipped *clipped,
                           const struct zr_builder_corner *corners)
{
    zr_vec4 values[ZR_CLIP_VALUES];
    for (int k = 0; k < clipped->corners; k++)
        values[k] = geometry->normals[corners[k].normal];
    append_values(clipped, values, geometry->normals + geometry->normal_count);
    geometry->normal_count += (uint32_t)clipped->count;
}

static void append_points(const struct zr_builder *builder, const struct zr_clipped *clipped,
                          const struct zr_builder_corner *corners)
{
    struct zr_geometry *geometry = builder->geometry;
    zr_vec4 values[ZR_CLIP_VALUES];
    for (int k = 0; k < clipped->corners; k++)
        values[k] = geometry->points[builder->first_vertex + corners[k].position];
    append_values(clipped, values, geometry->points + geometry->vertex_count);
}

static bool are_alike(const struct zr_clipped *clipped, const uint32_t *first, size_t stride)
{
    const uint32_t *second = first + stride, *last = first + stride * (size_t)(clipped->corners - 1);
    return *first == *second && *second == *last;
}

bool zr_builder_append_clipped(struct zr_builder *builder, const struct zr_clipped *clipped,
                               const struct zr_builder_corner *corners, bool placed[ZR_CLIP_MAX])
{
    struct zr_geometry *geometry = builder->geometry;
    const uint64_t count = (uint64_t)clipped->count;
    const size_t stride = sizeof *corners / sizeof corners->color;
    const bool flat = are_alike(clipped, &corners->color, stride), even = are_alike(clipped, &corners->normal, stride);
    zr_vec4 values[ZR_CLIP_VALUES], eyes[ZR_CLIP_MAX];
    if (!zr_builder_reserve(builder, count, flat ? 0 : count, 0)) return false;
    if (!even && !zr_builder_reserve_normals(builder, count)) return false;
    for (int k = 0; k < clipped->corners; k++) {
        const struct zr_eye eye = zr_builder_eye(builder, corners[k].position);
        values[k] = (zr_vec4){eye.z, eye.w, 0.0f, 0.0f};
    }
    append_values(clipped, values, eyes);
    if (builder->points) append_points(builder, clipped, corners);
    for (int i = 0; i < clipped->count; i++) {
        struct zr_window_vertex *vertex = &geometry->vertices[geometry->vertex_count++];
        placed[i] = zr_viewport_apply(&builder->viewport, clipped->vertices[i].position, vertex);
        geometry->eyes[geometry->vertex_count - 1] = (struct zr_eye){eyes[i].x, eyes[i].y};
    }
    if (!flat) append_colors(geometry, clipped, corners);
    if (!even) append_normals(geometry, clipped, corners);
    return true;
}

/* ---- normals ---- */

const zr_vec4 *zr_builder_normals(struct zr_builder *builder, enum zr_batch_rate rate)
{
    const zr_vec4 **normals = &builder->normals[rate];
    if (!*normals)
        *normals =
            zr_eye_normals_make(builder->arena, builder->team, builder->cancel, builder->mesh, &builder->object_to_eye,
                                rate, &builder->vertex_normals[builder->mesh - builder->scene->meshes]);
    return *normals;
}

bool zr_builder_add_normals(struct zr_builder *builder, uint32_t face, const uint32_t slots[3], uint32_t out[3])
{
    struct zr_geometry *g = builder->geometry;
    const struct zr_mesh *mesh = builder->mesh;
    const enum zr_batch_rate rate = zr_eye_normals_rate(mesh, zr_material_of_face(builder->scene, mesh, face));
    const zr_vec4 *normals = zr_builder_normals(builder, rate);
    const bool is_flat = rate == ZR_BATCH_PER_FACE;
    if (!normals || !zr_builder_reserve_normals(builder, 3)) return false;
    if (is_flat && builder->flat_face != face + 1) {
        builder->flat_face = face + 1;
        builder->flat_normal = g->normal_count;
        g->normals[g->normal_count++] = normals[face];
    }
    for (int k = 0; k < 3; k++) {
        out[k] = is_flat ? builder->flat_normal : g->normal_count;
        if (!is_flat)
            g->normals[g->normal_count++] = normals[rate == ZR_BATCH_PER_CORNER ? slots[k] : mesh->indices[slots[k]]];
    }
    return true;
}
