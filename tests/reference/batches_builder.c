#include "reference/batches_builder.h"

bool batches_reserve_corners(struct batches_builder *b, uint64_t more)
{
    uint64_t wanted = b->corner_count + more;
    if (wanted <= b->corner_room) return true;
    if (wanted > INT32_MAX) return false;
    uint32_t room = (uint32_t)(wanted + wanted / 2);
    b->positions = zr_arena_grow(b->arena, b->positions, b->corner_count, room, sizeof *b->positions);
    b->front = zr_arena_grow(b->arena, b->front, b->corner_count, room, sizeof *b->front);
    b->normals = zr_arena_grow(b->arena, b->normals, b->corner_count, room, sizeof *b->normals);
    b->unit_normals = zr_arena_grow(b->arena, b->unit_normals, b->corner_count, room, sizeof *b->unit_normals);
    b->light_points = zr_arena_grow(b->arena, b->light_points, b->corner_count, room, sizeof *b->light_points);
    b->corner_room = room;
    return zr_arena_ok(b->arena);
}

static bool same_state(const struct reference_batch *a, const struct reference_batch *b)
{
    return a->mode == b->mode && a->modelview == b->modelview && a->smooth == b->smooth && a->light == b->light &&
           a->normal_rows == b->normal_rows && a->cull == b->cull && a->mirrored == b->mirrored &&
           a->outline == b->outline && a->depth_offset == b->depth_offset && a->late == b->late &&
           a->material == b->material;
}

bool batches_append(struct batches_builder *b, const struct reference_batch *batch)
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

/* What is not see-through is opaque, whatever its colour says. */
static zr_vec4 with_opacity(const struct batches_builder *b, zr_vec4 color)
{
    const struct batches_only *only = b->options.only;
    if (!only || only->mode == ZR_ALPHA_OPAQUE) color.w = 1.0f;
    return color;
}

/* What lamps that have a place look at: a flat face is lit at its first corner. */
static void put_light_point(struct batches_builder *b, const struct batches_source *s, uint32_t at, uint32_t vertex,
                            zr_vec3 normal)
{
    const bool is_flat = s->material && s->material->shading == ZR_SHADING_FLAT;
    const zr_vec4 eye = zr_camera_eye(b->camera);
    if (is_flat) vertex = s->mesh->indices[s->mesh->face_offsets[s->face]];
    const zr_vec4 p = zr_mat4_apply(s->object_to_eye, s->mesh->positions[vertex]);
    const zr_vec3 point = {p.x, p.y, p.z}, n = zr_vec3_normalize(normal), *rows = s->normal_rows;
    b->light_points[at] = eye.w == 0.0f ? point : zr_vec3_sub(point, (zr_vec3){eye.x, eye.y, eye.z});
    b->unit_normals[at] =
        zr_vec3_normalize((zr_vec3){zr_vec3_dot(rows[0], n), zr_vec3_dot(rows[1], n), zr_vec3_dot(rows[2], n)});
}

void batches_append_vertex(struct batches_builder *b, const struct batches_source *s, uint32_t vertex, zr_vec4 color,
                           zr_vec3 normal)
{
    uint32_t at = b->corner_count++;
    zr_vec4 position = s->mesh->positions[vertex];
    if (b->options.transformed) {
        double clip[4];
        batches_transform(b->camera, &s->instance->object_to_world, position, clip);
        position = (zr_vec4){(float)clip[0], (float)clip[1], (float)clip[2], (float)clip[3]};
    }
    b->positions[at] = position;
    b->front[at] = with_opacity(b, color);
    b->normals[at] = normal;
    put_light_point(b, s, at, vertex, normal);
}
