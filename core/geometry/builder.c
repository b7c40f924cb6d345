#include "geometry/builder.h"

#include <string.h>

/* Work between two checks for cancellation: a few milliseconds if all of it is squared corner counts of triangulated
 * faces. */
enum { WORK_PER_CANCEL_CHECK = 1 << 20 };

bool zr_builder_go_on(struct zr_builder *builder, uint64_t work)
{
    builder->unchecked += work;
    if (builder->unchecked < WORK_PER_CANCEL_CHECK) return true;
    builder->unchecked = 0;
    return !zr_is_cancelled(builder->run->cancel);
}

/* ---- room ---- */

/* Returns the capacity to which an array of `room` grows for `more` items beside `count`: at least by half, so that
 * growth has constant amortized cost. 0: too many. */
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

bool zr_builder_reserve_vertices(struct zr_builder *builder, uint64_t more)
{
    struct zr_geometry *g = builder->geometry;
    void *vertices = g->vertices;
    if (!reserve(builder->run->arena, &vertices, &builder->vertex_room, g->vertex_count, more, sizeof *g->vertices))
        return false;
    g->vertices = vertices;
    return !g->eyes || zr_builder_reserve_eyes(builder);
}

bool zr_builder_reserve_eyes(struct zr_builder *builder)
{
    struct zr_geometry *g = builder->geometry;
    if (g->eyes && builder->eye_room >= builder->vertex_room) return true;
    struct zr_eye *eyes =
        zr_arena_grow(builder->run->arena, g->eyes, g->eyes ? g->vertex_count : 0, builder->vertex_room, sizeof *eyes);
    if (!eyes) return false;
    g->eyes = eyes;
    builder->eye_room = builder->vertex_room;
    return true;
}

bool zr_builder_reserve_shape(struct zr_builder *builder, uint64_t edges)
{
    struct zr_geometry *g = builder->geometry;
    void *edge_array = g->edges, *shapes = g->shapes;
    if (!reserve(builder->run->arena, &edge_array, &builder->edge_room, g->edge_count, edges, sizeof *g->edges))
        return false;
    g->edges = edge_array;
    if (!reserve(builder->run->arena, &shapes, &builder->shape_room, g->shape_count, 1, sizeof *g->shapes))
        return false;
    g->shapes = shapes;
    return true;
}

/* ---- draws ---- */

bool zr_builder_add_draw(struct zr_builder *builder, struct zr_draw draw)
{
    struct zr_geometry *g = builder->geometry;
    void *draws = g->draws;
    if (draw.count == 0) return true;
    if (draw.count > ZR_GEOMETRY_MAX - g->primitive_count) builder->run->arena->failed = true;
    if (builder->run->arena->failed ||
        !reserve(builder->run->arena, &draws, &builder->draw_room, g->draw_count, 1, sizeof *g->draws))
        return false;
    g->draws = draws;
    draw.first = g->primitive_count;
    draw.instance = builder->instance;
    draw.mesh = builder->mesh;
    draw.mirrored = builder->mirrored;
    draw.first_vertex = builder->first_vertex;
    draw.first_id = ZR_MUTANT(ids_of_the_first_instance, builder->first_face_id, 1u);
    g->primitive_count += draw.count;
    g->draws[g->draw_count++] = draw;
    return true;
}

enum { PLACED_AT_FIRST = 64, PLACED_MOST = 1 << 14 };

static bool make_room_to_place(struct zr_builder *builder)
{
    struct zr_placed *p = &builder->placed;
    struct zr_arena *arena = builder->run->arena;
    if (p->count < p->room) return true;
    const uint32_t room = p->room == 0 ? PLACED_AT_FIRST : p->room < PLACED_MOST ? 2 * p->room : PLACED_MOST;
    *p = (struct zr_placed){.room = room,
                            .corners = zr_arena_alloc(arena, room, 3 * sizeof *p->corners),
                            .slots = zr_arena_alloc(arena, room, 3 * sizeof *p->slots),
                            .faces = zr_arena_alloc(arena, room, sizeof *p->faces),
                            .traits = zr_arena_alloc(arena, room, sizeof *p->traits)};
    if (!zr_arena_ok(arena)) p->room = 0;
    return p->room > 0;
}

/* Returns true if the last draw ends with the primitive placed last and the next one has the same properties. */
static bool goes_on(const struct zr_builder *builder, const struct zr_common *common)
{
    const struct zr_geometry *g = builder->geometry;
    if (builder->placed.count == 0 || g->primitive_count >= ZR_GEOMETRY_MAX) return false;
    const struct zr_draw *last = &g->draws[g->draw_count - 1];
    return last->counted && last->instance == builder->instance && last->kind == common->kind &&
           last->material == common->material && last->depth_offset == common->depth_offset;
}

void zr_builder_place(struct zr_builder *builder, const struct zr_common *common, const struct zr_corner ends[3])
{
    struct zr_geometry *g = builder->geometry;
    struct zr_placed *p = &builder->placed;
    if (!make_room_to_place(builder)) return;
    const uint32_t at = p->count;
    if (goes_on(builder, common)) {
        g->draws[g->draw_count - 1].count++;
        g->primitive_count++;
    } else if (!zr_builder_add_draw(
                   builder, (struct zr_draw){.count = 1,
                                             .kind = common->kind,
                                             .depth_offset = common->depth_offset,
                                             .counted = true,
                                             .material = common->material,
                                             .corners = p->corners + 3 * at,
                                             .slots = p->slots + 3 * at,
                                             .faces = p->faces + at,
                                             .traits = common->kind == ZR_DRAW_TRIANGLES ? NULL : p->traits + at})) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        p->corners[3 * at + (uint32_t)k] = ends[k].vertex;
        p->slots[3 * at + (uint32_t)k] = ends[k].slot;
    }
    p->faces[at] = common->face;
    p->traits[at] = 2 * common->shape + common->back;
    p->count++;
}

/* ---- clipped primitives ---- */

static bool note_cut(struct zr_builder *builder, const struct zr_clipped *clipped, const struct zr_corner *corners)
{
    struct zr_geometry *g = builder->geometry;
    void *cuts = g->cuts;
    const size_t made_count = (size_t)clipped->made_count;
    struct zr_clip_made *made = zr_arena_alloc(builder->run->arena, made_count, sizeof *made);
    if (!made || !reserve(builder->run->arena, &cuts, &builder->cut_room, g->cut_count, 1, sizeof *g->cuts))
        return false;
    memcpy(made, clipped->made, made_count * sizeof *made);
    g->cuts = cuts;
    struct zr_cut *cut = &g->cuts[g->cut_count++];
    *cut = (struct zr_cut){.first_vertex = g->vertex_count,
                           .count = (uint8_t)clipped->count,
                           .corner_count = (uint8_t)clipped->corners,
                           .made_count = (uint8_t)made_count,
                           .made = made};
    for (int k = 0; k < clipped->corners; k++) {
        cut->corners[k] = corners[k].vertex;
        cut->slots[k] = corners[k].slot;
    }
    for (int i = 0; i < clipped->count; i++)
        cut->ids[i] = clipped->vertices[i].id;
    return true;
}

/* Clips the eye depths of the corners like their positions, to out[]. */
static void cut_eyes(const struct zr_builder *builder, const struct zr_cut *cut, struct zr_eye *out)
{
    static const uint32_t own[3] = {0, 1, 2};
    zr_vec4 values[3], left[ZR_CLIP_MAX];
    for (int k = 0; k < cut->corner_count; k++) {
        const struct zr_eye eye = zr_builder_eye(builder, cut->corners[k]);
        values[k] = (zr_vec4){eye.z, eye.w, 0.0f, 0.0f};
    }
    zr_cut_values(cut, values, own, left);
    for (int i = 0; i < cut->count; i++)
        out[i] = (struct zr_eye){left[i].x, left[i].y};
}

bool zr_builder_append_cut(struct zr_builder *builder, const struct zr_clipped *clipped,
                           const struct zr_corner *corners, struct zr_corner ends[ZR_CLIP_MAX],
                           bool placed[ZR_CLIP_MAX])
{
    struct zr_geometry *g = builder->geometry;
    if (!zr_builder_reserve_vertices(builder, (uint64_t)clipped->count) || !zr_builder_reserve_eyes(builder) ||
        !note_cut(builder, clipped, corners))
        return false;
    const struct zr_mesh *mesh = builder->mesh;
    const uint32_t slots = mesh->face_offsets[mesh->face_count], first = g->vertex_count - builder->first_vertex;
    cut_eyes(builder, &g->cuts[g->cut_count - 1], g->eyes + g->vertex_count);
    for (int i = 0; i < clipped->count; i++) {
        placed[i] =
            zr_viewport_apply(&builder->viewport, clipped->vertices[i].position, &g->vertices[g->vertex_count++]);
        ends[i].vertex = first + (uint32_t)i;
        ends[i].slot = slots + (ends[i].vertex - mesh->position_count);
    }
    return true;
}
