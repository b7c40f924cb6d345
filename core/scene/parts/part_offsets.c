#include "scene/parts/part_offsets.h"

#include "base/cancel.h"
#include "base/dvec3.h"

enum { POINTS_PER_CANCEL_CHECK = 1 << 14 };

struct box {
    double min[3], max[3];
};

static void clear(struct box *box)
{
    for (int k = 0; k < 3; k++) {
        box->min[k] = HUGE_VAL;
        box->max[k] = -HUGE_VAL;
    }
}

static void extend(struct box *box, const double at[3])
{
    for (int k = 0; k < 3; k++) {
        if (at[k] < box->min[k]) box->min[k] = at[k];
        if (at[k] > box->max[k]) box->max[k] = at[k];
    }
}

static void add_point(struct box *box, const zr_mat4 *matrix, zr_vec4 position)
{
    zr_dvec3 p;
    if (zr_place_of(zr_mat4_apply(matrix, position), &p)) extend(box, (const double[3]){p.x, p.y, p.z});
}

/* Extends boxes[p] by the faces of part p. False if cancelled. */
static bool add_faces(const struct zr_mesh *mesh, const zr_mat4 *matrix, const struct zr_cancel *cancel,
                      struct box *boxes)
{
    uint32_t corner = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        for (; corner < mesh->face_offsets[f + 1]; corner++) {
            if (corner % POINTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
            add_point(&boxes[mesh->face_parts[f]], matrix, mesh->positions[mesh->indices[corner]]);
        }
    return true;
}

static bool add_positions(const struct zr_mesh *mesh, const zr_mat4 *matrix, const struct zr_cancel *cancel,
                          struct box *box)
{
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        if (i % POINTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        add_point(box, matrix, mesh->positions[i]);
    }
    return true;
}

static struct box *find_boxes(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_part_list *list)
{
    struct box *boxes = zr_arena_alloc(arena, list->count, sizeof *boxes), *next = boxes;
    if (!boxes) return NULL;
    for (uint32_t p = 0; p < list->count; p++)
        clear(&boxes[p]);
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        const struct zr_mesh *mesh = &scene->meshes[instance->mesh];
        const bool is_good = mesh->face_parts ? add_faces(mesh, &instance->object_to_world, arena->cancel, next)
                                              : add_positions(mesh, &instance->object_to_world, arena->cancel, next);
        if (!is_good) return NULL;
        next += zr_mesh_part_count(mesh);
    }
    return boxes;
}

static double middle_of(const struct box *box, int axis)
{
    return 0.5 * box->min[axis] + 0.5 * box->max[axis];
}

const struct zr_part_offset *zr_part_offsets_find(struct zr_arena *arena, const struct zr_scene *scene,
                                                  const struct zr_part_list *list, bool *moves)
{
    const struct zr_part_keys *keys = &scene->parts;
    struct zr_part_offset *offsets = zr_arena_zero(arena, list->count, sizeof *offsets);
    const struct box *boxes = find_boxes(arena, scene, list);
    struct box all;
    *moves = false;
    if (!offsets || !boxes) return NULL;
    clear(&all);
    for (uint32_t p = 0; p < list->count; p++) {
        if (!(boxes[p].min[0] <= boxes[p].max[0])) continue;
        extend(&all, boxes[p].min);
        extend(&all, boxes[p].max);
    }
    for (uint32_t p = 0; p < list->count; p++) {
        if (!(boxes[p].min[0] <= boxes[p].max[0])) continue;
        for (int k = 0; k < 3; k++) {
            if (keys->explode_axis != ZR_EXPLODE_RADIAL && (int)keys->explode_axis - (int)ZR_EXPLODE_X != k) continue;
            offsets[p].by[k] = keys->explode * (middle_of(&boxes[p], k) - middle_of(&all, k));
            *moves = *moves || offsets[p].by[k] != 0.0;
        }
    }
    return offsets;
}
