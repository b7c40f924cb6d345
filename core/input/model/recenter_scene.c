#include "input/model/recenter_scene.h"

/* Positions or instances between two checks of the cancel flag: less than a millisecond. */
enum { AT_ONCE = 1 << 13 };

static bool is_moved(const struct zr_recenter_scene *scene)
{
    bool is_any = false;
    for (uint32_t i = 0; i < scene->count; i++)
        is_any = is_any || scene->moves[scene->instances[i].mesh];
    return is_any;
}

/* True if samples of the positions, as placed in float, are nearly remote: a remote scene's always are. */
static bool may_be_remote(const struct zr_recenter_scene *scene)
{
    struct zr_box box = zr_box_empty();
    for (uint32_t i = 0; i < scene->count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        const struct zr_mesh *mesh = &scene->meshes[instance->mesh];
        const uint32_t samples[3] = {0, mesh->position_count / 2, mesh->position_count - 1};
        for (int k = 0; k < 3 && mesh->position_count > 0; k++) {
            const zr_vec4 at = zr_mat4_apply(&instance->object_to_world, mesh->positions[samples[k]]);
            zr_box_include(&box, (const double[]){(double)at.x, (double)at.y, (double)at.z});
        }
    }
    return box.low[0] <= box.high[0] && zr_box_is_remote(&box, ZR_FAR_SIZES / 2.0);
}

bool zr_recenter_instances_needed(const struct zr_recenter_scene *scene, const struct zr_limits *limits)
{
    const float limit = limits->coordinate_max;
    bool is_far = is_moved(scene);
    for (uint32_t i = 0; i < scene->count; i++) {
        const float *at = &scene->instances[i].object_to_world.m[12];
        is_far = is_far || fabsf(at[0]) > limit || fabsf(at[1]) > limit || fabsf(at[2]) > limit;
    }
    return is_far || may_be_remote(scene);
}

/* ---- bounds ---- */

/* Finds the bounds of positions. False if cancelled. */
static bool find_box(const struct zr_cancel *cancel, const zr_vec4 *positions, size_t count, struct zr_box *box)
{
    *box = zr_box_empty();
    for (size_t i = 0; i < count; i++) {
        const double v[3] = {(double)positions[i].x, (double)positions[i].y, (double)positions[i].z};
        if (i % AT_ONCE == 0 && zr_is_cancelled(cancel)) return false;
        zr_box_include(box, v);
    }
    return true;
}

enum zr_status zr_recenter_move_floats(const struct zr_run *run, const struct zr_limits *limits, zr_vec4 *positions,
                                       size_t count, const struct zr_recenter_move **move)
{
    struct zr_recenter_move *made = zr_arena_zero(run->arena, 1, sizeof *made);
    *move = NULL;
    if (!made) return ZR_NO_MEMORY;
    if (!find_box(run->cancel, positions, count, &made->box)) return ZR_CANCELLED;
    const enum zr_status status = zr_recenter_shift(run, limits, positions, count, &made->by);
    if (made->by) *move = made;
    return status;
}

/* Finds the bounds of each mesh that an instance uses, in the coordinates of the file. False if cancelled. */
static bool find_boxes(const struct zr_cancel *cancel, const struct zr_recenter_scene *scene, struct zr_box *boxes)
{
    for (uint32_t i = 0; i < scene->count; i++)
        boxes[scene->instances[i].mesh] = (struct zr_box){{0}, {-1, -1, -1}}; /* not found yet */
    for (uint32_t i = 0; i < scene->count; i++) {
        const uint32_t number = scene->instances[i].mesh;
        const struct zr_mesh *mesh = &scene->meshes[number];
        if (i % AT_ONCE == 0 && zr_is_cancelled(cancel)) return false;
        if (!(boxes[number].low[0] == 0.0 && boxes[number].high[0] < 0.0)) continue;
        if (scene->moves[number])
            boxes[number] = scene->moves[number]->box;
        else if (!find_box(cancel, mesh->positions, mesh->position_count, &boxes[number]))
            return false;
    }
    return true;
}

/* True if the middle is beyond the limit, and the size is not too large to move it; or if the scene is remote. */
static bool has_far_middle(const struct zr_box *box, double limit)
{
    bool is_far = false, is_small = true;
    for (int axis = 0; axis < 3; axis++) {
        is_far = is_far || fabs(box->low[axis] / 2.0 + box->high[axis] / 2.0) > limit;
        is_small = is_small && (box->high[axis] - box->low[axis]) / 2.0 <= limit * ZR_FAR_HALF_EXTENTS;
    }
    return (is_far && is_small) || (box->low[0] <= box->high[0] && zr_box_is_remote(box, ZR_FAR_SIZES));
}

/* ---- matrices ---- */

/* Returns the matrix for positions of a moved mesh, with the origin subtracted. */
static zr_mat4 matrix_of(const struct zr_matrix *exact, const struct zr_recenter_move *move, const double *origin)
{
    const double zero[3] = {0}, *from = move ? move->by : zero;
    const double v[4] = {from[0], from[1], from[2], 1};
    double at[4];
    zr_mat4 out;
    zr_matrix_apply(exact, v, at);
    for (int i = 0; i < 16; i++)
        out.m[i] = (float)exact->m[i];
    for (int axis = 0; axis < 3; axis++)
        out.m[12 + axis] = (float)(at[axis] - (origin ? origin[axis] : 0.0));
    return out;
}

enum zr_status zr_recenter_instances(const struct zr_run *run, const struct zr_limits *limits,
                                     const struct zr_recenter_scene *scene, const double **origin)
{
    uint32_t meshes = 0;
    *origin = NULL;
    for (uint32_t i = 0; i < scene->count; i++)
        if (scene->instances[i].mesh >= meshes) meshes = scene->instances[i].mesh + 1;
    struct zr_box *boxes = zr_arena_alloc(run->arena, meshes, sizeof *boxes), all = zr_box_empty();
    if (!boxes) return ZR_NO_MEMORY;
    if (!find_boxes(run->cancel, scene, boxes)) return ZR_CANCELLED;
    for (uint32_t i = 0; i < scene->count; i++) {
        if (i % AT_ONCE == 0 && zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        zr_box_include_placed(&all, &boxes[scene->instances[i].mesh], &scene->exact[i]);
    }
    if (!is_moved(scene) && !has_far_middle(&all, (double)limits->coordinate_max)) return ZR_OK;
    const enum zr_status status = zr_recenter_origin(run->arena, &all, limits, origin, run->error);
    for (uint32_t i = 0; status == ZR_OK && i < scene->count; i++) {
        if (i % AT_ONCE == 0 && zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        scene->instances[i].object_to_world =
            matrix_of(&scene->exact[i], scene->moves[scene->instances[i].mesh], *origin);
    }
    return status;
}
