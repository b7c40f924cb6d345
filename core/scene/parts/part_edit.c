#include "scene/parts/part_edit.h"

#include <string.h>

#include "base/cancel.h"
#include "base/matrix.h"

/* A changed copy of a mesh. Further instances with the same styles share it. */
struct copy {
    uint32_t mesh;       /* number in the scene */
    uint32_t first_part; /* first part of the instance that it was made for */
    uint32_t older;      /* 1 + the number of an older copy of the same mesh, or 0 */
};

struct editing {
    struct zr_scene_builder *builder;
    const struct zr_part_edit *edit;
    struct zr_mesh *meshes;
    uint32_t *owners;
    uint32_t mesh_count;
    size_t mesh_room;
    struct copy *copies;
    uint32_t copy_count;
    uint32_t *newest; /* per mesh of the scene: 1 + the number of its newest copy, or 0 */
    bool *is_free;    /* per mesh of the scene: a changed copy may replace it */
};

/* Maximum number of copies that are compared before another copy is made. */
enum { COPIES_COMPARED = 256 };

static bool is_plain(const uint32_t *styles, uint32_t count)
{
    for (uint32_t p = 0; p < count; p++)
        if (styles[p] != 0) return false;
    return true;
}

/* True if an instance keeps its mesh. `first_part`: number of its first part. */
static bool keeps_mesh(const struct zr_part_edit *edit, const struct zr_mesh *mesh, uint32_t first_part)
{
    return is_plain(edit->styles + first_part, zr_mesh_part_count(mesh)) && !(edit->offsets && mesh->face_parts) &&
           !(edit->hides_rest && zr_mesh_has_rest(mesh));
}

/* Returns the number for a changed copy of a mesh, or UINT32_MAX without memory. */
static uint32_t take_place(struct editing *e, uint32_t mesh)
{
    struct zr_arena *arena = e->builder->arena;
    if (e->is_free[mesh]) {
        e->is_free[mesh] = false;
        return mesh;
    }
    if (e->mesh_count == e->mesh_room) {
        const size_t room = e->mesh_room + e->mesh_room / 2 + 16;
        struct zr_mesh *meshes = zr_arena_grow(arena, e->meshes, e->mesh_count, room, sizeof *meshes);
        uint32_t *owners = zr_arena_alloc(arena, room, sizeof *owners);
        if (!zr_arena_ok(arena)) return UINT32_MAX;
        memcpy(owners, e->owners, e->mesh_count * sizeof *owners);
        e->meshes = meshes;
        e->owners = owners;
        e->mesh_room = room;
    }
    e->owners[e->mesh_count] = e->owners[mesh];
    return e->mesh_count++;
}

/* Returns the number of a copy with the same styles, or UINT32_MAX. */
static uint32_t find_copy(const struct editing *e, uint32_t mesh, uint32_t first_part, uint32_t parts)
{
    const uint32_t *styles = e->edit->styles;
    uint32_t at = e->newest[mesh];
    for (int i = 0; at != 0 && i < COPIES_COMPARED; i++, at = e->copies[at - 1].older)
        if (memcmp(styles + e->copies[at - 1].first_part, styles + first_part, parts * sizeof *styles) == 0)
            return e->copies[at - 1].mesh;
    return UINT32_MAX;
}

/* Makes a copy for the styles and offsets of an instance's parts. Returns its number, or UINT32_MAX on failure. */
static uint32_t make_mesh(struct editing *e, uint32_t mesh, uint32_t first_part, const struct zr_part_offset *offsets)
{
    const struct zr_part_mesh_edit edit = {.styles = e->edit->styles + first_part,
                                           .colors = e->edit->colors,
                                           .hides_rest = e->edit->hides_rest,
                                           .offsets = offsets};
    const uint32_t number = take_place(e, mesh);
    if (number == UINT32_MAX ||
        !zr_part_mesh_make(e->builder, &e->builder->scene->meshes[mesh], &edit, &e->meshes[number]))
        return UINT32_MAX;
    if (offsets) return number;
    e->copies[e->copy_count++] = (struct copy){number, first_part, e->newest[mesh]};
    e->newest[mesh] = e->copy_count;
    return number;
}

/* Converts offsets to object space. NULL without memory, or if the matrix has no inverse, which sets *is_flat. */
static const struct zr_part_offset *to_object_space(struct zr_arena *arena, const zr_mat4 *object_to_world,
                                                    const struct zr_part_offset *offsets, uint32_t count, bool *is_flat)
{
    struct zr_matrix matrix = zr_matrix_of(object_to_world), inverse;
    matrix.m[12] = matrix.m[13] = matrix.m[14] = 0.0;
    *is_flat = !zr_matrix_invert(&matrix, &inverse);
    struct zr_part_offset *out = *is_flat ? NULL : zr_arena_alloc(arena, count, sizeof *out);
    for (uint32_t p = 0; out && p < count; p++) {
        const double *by = offsets[p].by;
        for (int k = 0; k < 3; k++)
            out[p].by[k] = (inverse.m[k] * by[0] + inverse.m[4 + k] * by[1]) + inverse.m[8 + k] * by[2];
    }
    return out;
}

static enum zr_part_edit_result edit_instance(struct editing *e, struct zr_instance *instance, uint32_t first_part)
{
    const struct zr_mesh *mesh = &e->builder->scene->meshes[instance->mesh];
    const uint32_t parts = zr_mesh_part_count(mesh);
    const struct zr_part_offset *offsets = e->edit->offsets ? e->edit->offsets + first_part : NULL;
    if (offsets && !mesh->face_parts) {
        for (int k = 0; k < 3; k++)
            instance->object_to_world.m[12 + k] = (float)((double)instance->object_to_world.m[12 + k] + offsets->by[k]);
        offsets = NULL;
    }
    if (offsets) {
        bool is_flat;
        offsets = to_object_space(e->builder->arena, &instance->object_to_world, offsets, parts, &is_flat);
        if (!offsets) return is_flat ? ZR_PART_EDIT_FLAT : ZR_PART_EDIT_FAILED;
    }
    if (keeps_mesh(e->edit, mesh, first_part)) return ZR_PART_EDIT_DONE;
    uint32_t number = offsets ? UINT32_MAX : find_copy(e, instance->mesh, first_part, parts);
    if (number == UINT32_MAX) number = make_mesh(e, instance->mesh, first_part, offsets);
    if (number == UINT32_MAX) return ZR_PART_EDIT_FAILED;
    instance->mesh = number;
    return ZR_PART_EDIT_DONE;
}

static bool open(struct editing *e)
{
    const struct zr_scene *scene = e->builder->scene;
    struct zr_arena *arena = e->builder->arena;
    e->mesh_count = scene->mesh_count;
    e->mesh_room = scene->mesh_count;
    e->meshes = zr_arena_copy(arena, scene->meshes, scene->mesh_count * sizeof *scene->meshes);
    e->owners = zr_arena_alloc(arena, scene->mesh_count, sizeof *e->owners);
    e->newest = zr_arena_zero(arena, scene->mesh_count, sizeof *e->newest);
    e->is_free = zr_arena_alloc(arena, scene->mesh_count, sizeof *e->is_free);
    e->copies = zr_arena_alloc(arena, scene->instance_count, sizeof *e->copies);
    if (!zr_arena_ok(arena)) return false;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        e->owners[i] = scene->mesh_owners ? scene->mesh_owners[i] : i;
        e->is_free[i] = true;
    }
    uint32_t part = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const uint32_t mesh = scene->instances[i].mesh;
        if (keeps_mesh(e->edit, &scene->meshes[mesh], part)) e->is_free[mesh] = false;
        part += zr_mesh_part_count(&scene->meshes[mesh]);
    }
    return true;
}

enum zr_part_edit_result zr_part_edit(struct zr_scene_builder *builder, const struct zr_part_edit *edit,
                                      uint32_t *instance)
{
    struct editing e = {.builder = builder, .edit = edit};
    struct zr_scene *scene = builder->scene;
    struct zr_instance *instances =
        zr_arena_copy(builder->arena, scene->instances, scene->instance_count * sizeof *instances);
    uint32_t part = 0;
    if (!instances || !open(&e)) return ZR_PART_EDIT_FAILED;
    for (*instance = 0; *instance < scene->instance_count; ++*instance) {
        const uint32_t parts = zr_mesh_part_count(&scene->meshes[instances[*instance].mesh]);
        if (zr_is_cancelled(builder->arena->cancel)) return ZR_PART_EDIT_FAILED;
        const enum zr_part_edit_result result = edit_instance(&e, &instances[*instance], part);
        if (result != ZR_PART_EDIT_DONE) return result;
        part += parts;
    }
    scene->instances = instances;
    scene->meshes = e.meshes;
    scene->mesh_count = e.mesh_count;
    scene->mesh_owners = e.owners;
    scene->materials = builder->materials;
    scene->has_box = false;
    return ZR_PART_EDIT_DONE;
}
