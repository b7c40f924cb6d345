#include "reference/batches.h"

#include "geometry/colors.h"
#include "geometry/normals.h"
#include "scene/scene.h"
#if __has_include("geometry/triangulate.h")
#include "geometry/triangulate.h"
#endif

/* Until core/geometry draws concave faces and holes by the odd-even rule, both sides draw their fan. */
enum { CONCAVE_BY_PARITY = 0 };

/* ---- owners as colours ---- */

/* Both odd, and inverse to each other modulo 2^24. */
static const uint32_t scatter = 0x9e3779u, gather = 0xb382c9u;

zr_vec4 batches_owner_color(uint32_t number)
{
    uint32_t c = number * scatter;
    return (zr_vec4){(float)(c & 255) / 255.0f, (float)(c >> 8 & 255) / 255.0f, (float)(c >> 16 & 255) / 255.0f, 1.0f};
}

uint32_t batches_owner_number(const uint8_t rgba[4])
{
    uint32_t c = rgba[0] | (uint32_t)rgba[1] << 8 | (uint32_t)rgba[2] << 16;
    return c * gather & BATCHES_OWNERS_MAX;
}

/* ---- places ---- */

static void apply_in_double(const zr_mat4 *m, double v[4])
{
    double out[4];
    for (int row = 0; row < 4; row++)
        out[row] = (double)m->m[row] * v[0] +
                   ((double)m->m[4 + row] * v[1] + ((double)m->m[8 + row] * v[2] + (double)m->m[12 + row] * v[3]));
    for (int row = 0; row < 4; row++)
        v[row] = out[row];
}

void batches_transform(const struct zr_camera *camera, const zr_mat4 *object_to_world, zr_vec4 position, double clip[4])
{
    clip[0] = (double)position.x;
    clip[1] = (double)position.y;
    clip[2] = (double)position.z;
    clip[3] = (double)position.w;
    apply_in_double(object_to_world, clip);
    apply_in_double(&camera->world_to_eye, clip);
    apply_in_double(&camera->projection, clip);
}

bool batches_is_mirrored(const zr_mat4 *object_to_world)
{
    const float *m = object_to_world->m;
    zr_vec3 x = {m[0], m[1], m[2]}, y = {m[4], m[5], m[6]}, z = {m[8], m[9], m[10]};
    return zr_vec3_dot(zr_vec3_cross(x, y), z) < 0.0f;
}

/* ---- building ---- */

struct builder {
    struct zr_arena *arena;
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    struct batches_options options;
    struct batches *out;
    zr_vec4 *positions, *front, *back;
    struct reference_batch *batches;
    uint32_t corner_count, corner_room, batch_room;
    uint32_t owner; /* of the first face of the instance under way */
};

/* One instance of a mesh on its way, and one of its faces. */
struct source {
    const struct zr_mesh *mesh;
    const struct zr_instance *instance;
    const zr_mat4 *modelview;
    struct zr_colors colors;
    bool mirrored;
    const struct zr_material *material; /* of the face under way */
    bool smooth;
    uint32_t face;
};

static bool reserve_corners(struct builder *b, uint64_t more)
{
    uint64_t wanted = b->corner_count + more;
    if (wanted <= b->corner_room) return true;
    if (wanted > INT32_MAX) return false;
    uint32_t room = (uint32_t)(wanted + wanted / 2);
    b->positions = zr_arena_grow(b->arena, b->positions, b->corner_count, room, sizeof *b->positions);
    b->front = zr_arena_grow(b->arena, b->front, b->corner_count, room, sizeof *b->front);
    b->back = zr_arena_grow(b->arena, b->back, b->corner_count, room, sizeof *b->back);
    b->corner_room = room;
    return zr_arena_ok(b->arena);
}

static bool same_state(const struct reference_batch *a, const struct reference_batch *b)
{
    return a->mode == b->mode && a->modelview == b->modelview && a->smooth == b->smooth &&
           a->two_sided == b->two_sided && a->cull == b->cull && a->mirrored == b->mirrored &&
           a->outline == b->outline && a->pushed == b->pushed;
}

/* Joins the batch before, where the mode allows it and the state is the same. */
static bool append_batch(struct builder *b, const struct reference_batch *batch)
{
    struct reference_batch *last = b->out->arrays.batch_count ? &b->batches[b->out->arrays.batch_count - 1] : NULL;
    bool joins = batch->mode == REFERENCE_TRIANGLES || batch->mode == REFERENCE_LINES;
    if (joins && last && same_state(last, batch) && last->first + last->count == batch->first) {
        last->count += batch->count;
        return true;
    }
    if (b->out->arrays.batch_count == b->batch_room) {
        uint32_t room = b->batch_room * 2 + 64;
        b->batches = zr_arena_grow(b->arena, b->batches, b->batch_room, room, sizeof *b->batches);
        if (!b->batches) return false;
        b->batch_room = room;
    }
    b->batches[b->out->arrays.batch_count++] = *batch;
    return true;
}

static zr_vec4 opaque(zr_vec4 color)
{
    color.w = 1.0f; /* what we draw is, whatever its colour says */
    return color;
}

/* Corner `slot` of the mesh's indices. */
static void append_corner(struct builder *b, const struct source *s, uint32_t slot)
{
    uint32_t vertex = s->mesh->indices[slot], at = b->corner_count++;
    zr_vec4 position = s->mesh->positions[vertex];
    if (b->options.transformed) {
        double clip[4];
        batches_transform(b->camera, &s->instance->object_to_world, position, clip);
        position = (zr_vec4){(float)clip[0], (float)clip[1], (float)clip[2], (float)clip[3]};
    }
    b->positions[at] = position;
    if (b->options.purpose == BATCHES_OWNERS) {
        b->front[at] = b->back[at] = batches_owner_color(b->owner + s->face);
        return;
    }
    uint32_t color = s->colors.layout == ZR_COLOR_PER_FACE     ? s->face
                     : s->colors.layout == ZR_COLOR_PER_VERTEX ? vertex
                     : s->smooth                               ? slot
                                                               : s->mesh->face_offsets[s->face];
    b->front[at] = opaque(s->colors.front[color]);
    b->back[at] = opaque(s->colors.back[color]);
}

/* ---- faces ---- */

static bool is_concave(const struct zr_mesh *mesh, uint32_t face)
{
#ifdef ZR_TRIANGULATE_H
    return zr_face_is_concave(mesh, face);
#else
    return zr_face_is_concave(mesh, face, zr_normal_of_face(mesh, face));
#endif
}

bool batches_face_is_parity(const struct zr_mesh *mesh, uint32_t face)
{
    if (!CONCAVE_BY_PARITY) return false;
    if (mesh->face_rings && mesh->face_rings[face + 1] - mesh->face_rings[face] > 1) return true;
    return mesh->face_offsets[face + 1] - mesh->face_offsets[face] > 3 && is_concave(mesh, face);
}

/* The fan (i - 1, i, 0), as GL_POLYGON has it. */
static void append_fan(struct builder *b, const struct source *s, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin + 2; i < end; i++) {
        append_corner(b, s, i - 1);
        append_corner(b, s, i);
        append_corner(b, s, begin);
    }
}

#ifdef ZR_TRIANGULATE_H
/* The triangles that core/geometry cuts the face into, in its order: they decide which plane a sample has. */
static bool append_cut(struct builder *b, const struct source *s, const uint32_t *ring_offsets, uint32_t rings)
{
    uint32_t begin = ring_offsets[0], corners = ring_offsets[rings] - begin;
    uint32_t most = zr_triangulate_count_max(corners, rings);
    struct zr_triangulator scratch = {.node_capacity = 0};
    zr_vec4 *points = zr_arena_alloc(b->arena, corners, sizeof *points);
    uint32_t *offsets = zr_arena_alloc(b->arena, rings + (size_t)1, sizeof *offsets);
    uint32_t(*triangles)[3] = zr_arena_alloc(b->arena, most, sizeof *triangles);
    if (!zr_triangulator_reserve(b->arena, &scratch, corners, rings) || !zr_arena_ok(b->arena)) return false;
    for (uint32_t i = 0; i < corners; i++)
        points[i] = s->mesh->positions[s->mesh->indices[begin + i]];
    for (uint32_t ring = 0; ring <= rings; ring++)
        offsets[ring] = ring_offsets[ring] - begin;
    uint32_t count = zr_triangulate(&scratch, points, offsets, rings, triangles);
    if (!reserve_corners(b, 3 * (uint64_t)count)) return false;
    for (uint32_t i = 0; i < 3 * count; i++)
        append_corner(b, s, begin + triangles[i / 3][i % 3]);
    return true;
}
#else
static bool append_cut(struct builder *b, const struct source *s, const uint32_t *ring_offsets, uint32_t rings)
{
    append_fan(b, s, ring_offsets[0], ring_offsets[rings]);
    return true;
}
#endif

static bool append_parity(struct builder *b, const struct source *s, struct reference_batch *batch)
{
    const struct zr_mesh *mesh = s->mesh;
    uint32_t begin = mesh->face_offsets[s->face], end = mesh->face_offsets[s->face + 1], rings = 1;
    const uint32_t *ring_offsets = mesh->face_offsets + s->face;
    if (mesh->face_rings) {
        rings = mesh->face_rings[s->face + 1] - mesh->face_rings[s->face];
        ring_offsets = mesh->ring_offsets + mesh->face_rings[s->face];
    }
    if (!reserve_corners(b, 6 * (uint64_t)(end - begin))) return false;
    batch->mode = REFERENCE_PARITY;
    batch->rings_first = b->corner_count;
    for (uint32_t ring = 0; ring < rings; ring++)
        append_fan(b, s, ring_offsets[ring], ring_offsets[ring + 1]);
    batch->rings_count = b->corner_count - batch->rings_first;
    batch->first = b->corner_count;
    bool convex = !batches_face_is_parity(mesh, s->face); /* options.all_parity: as GL_POLYGON would cut it */
    if (convex)
        append_fan(b, s, begin, end);
    else if (!append_cut(b, s, ring_offsets, rings))
        return false;
    batch->count = b->corner_count - batch->first;
    b->out->parity_faces++;
    return append_batch(b, batch);
}

static bool append_face(struct builder *b, const struct source *s)
{
    uint32_t begin = s->mesh->face_offsets[s->face], end = s->mesh->face_offsets[s->face + 1];
    bool lit = s->material->shading != ZR_SHADING_UNLIT;
    struct reference_batch batch = {.mode = end - begin == 3 ? REFERENCE_TRIANGLES : REFERENCE_POLYGON,
                                    .modelview = s->modelview,
                                    .smooth = s->smooth && b->options.purpose == BATCHES_COLORS,
                                    .two_sided = lit && s->material->double_sided,
                                    .cull = !s->material->double_sided,
                                    .mirrored = s->mirrored};
    if (b->options.purpose == BATCHES_OWNERS) batch.two_sided = false;
    b->out->triangles += end - begin - 2;
    bool parity = batches_face_is_parity(s->mesh, s->face) || (b->options.all_parity && end - begin > 3);
    if (parity) return append_parity(b, s, &batch);
    if (!reserve_corners(b, end - begin)) return false;
    batch.first = b->corner_count;
    batch.count = end - begin;
    for (uint32_t slot = begin; slot < end; slot++)
        append_corner(b, s, slot);
    return append_batch(b, &batch);
}

/* ---- instances ---- */

static bool make_colors(struct builder *b, struct source *s, const struct zr_lighting *lighting)
{
    if (b->options.purpose == BATCHES_OWNERS) return true;
    uint32_t count = zr_colors_count(b->scene, s->mesh);
    zr_vec4 *front = zr_arena_alloc(b->arena, count, sizeof *front);
    zr_vec4 *back = zr_arena_alloc(b->arena, count, sizeof *back);
    if (!zr_arena_ok(b->arena)) return false;
    zr_mat4 object_to_eye = zr_mat4_mul(&b->camera->world_to_eye, &s->instance->object_to_world);
    s->colors = zr_colors_make(b->arena, NULL, b->scene, s->mesh, lighting, &object_to_eye, front, back);
    return zr_arena_ok(b->arena);
}

static bool append_instance(struct builder *b, const struct zr_instance *instance, const struct zr_lighting *lighting)
{
    const struct zr_mesh *mesh = &b->scene->meshes[instance->mesh];
    zr_mat4 *modelview = zr_arena_alloc(b->arena, 1, sizeof *modelview);
    if (!modelview) return false;
    *modelview =
        b->options.transformed ? zr_mat4_identity() : zr_mat4_mul(&b->camera->world_to_eye, &instance->object_to_world);
    struct source source = {.mesh = mesh,
                            .instance = instance,
                            .modelview = modelview,
                            .mirrored = batches_is_mirrored(&instance->object_to_world)};
    if (b->owner + zr_mesh_ids(mesh) > (uint64_t)BATCHES_OWNERS_MAX + 1) return false;
    if (!make_colors(b, &source, lighting)) return false;
    for (source.face = 0; source.face < mesh->face_count; source.face++) {
        source.material = zr_material_of_face(b->scene, mesh, source.face);
        source.smooth = zr_material_is_smooth(mesh, source.material);
        if (!append_face(b, &source)) return false;
    }
    b->owner += (uint32_t)zr_mesh_ids(mesh);
    return true;
}

bool batches_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                  const struct batches_options *options, struct batches *batches)
{
    *batches = (struct batches){.triangles = 0};
    struct builder builder = {
        .arena = arena, .scene = scene, .camera = camera, .options = *options, .out = batches, .owner = 1};
    struct zr_lighting lighting;
    zr_lighting_make(arena, scene, &camera->world_to_eye, &lighting);
    if (!zr_arena_ok(arena)) return false;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        if (!append_instance(&builder, &scene->instances[i], &lighting)) return false;
    struct reference_arrays *arrays = &batches->arrays;
    arrays->positions = builder.positions;
    arrays->front = builder.front;
    arrays->back = options->purpose == BATCHES_COLORS ? builder.back : NULL;
    arrays->batches = builder.batches;
    arrays->projection = options->transformed ? zr_mat4_identity() : camera->projection;
    arrays->background = options->purpose == BATCHES_COLORS ? scene->background : (zr_vec4){0, 0, 0, 1};
    return true;
}
