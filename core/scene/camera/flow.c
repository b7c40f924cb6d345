#include "scene/camera/flow.h"

#include <stdio.h>
#include <string.h>

#include "base/run.h"

bool zr_flow_scene(struct zr_arena *arena, const struct zr_scene *scene, struct zr_scene *out)
{
    const zr_mat4 *matrices = scene->flow ? scene->flow->matrices : NULL;
    *out = *scene;
    out->flow = NULL;
    if (!matrices) return true;
    struct zr_instance *instances =
        zr_arena_copy(arena, scene->instances, scene->instance_count * sizeof *scene->instances);
    for (uint32_t i = 0; instances && i < scene->instance_count; i++)
        instances[i].object_to_world = matrices[i];
    out->instances = instances;
    out->has_box = false;
    return instances != NULL;
}

/* Gives a view the pose and the size of the camera. Near and far plane stay those of the view. */
static void use_camera(const struct zr_camera *own, struct zr_view *view)
{
    view->pose = ZR_POSE_MATRIX;
    view->world_to_camera = own->world_to_eye;
    if (view->projection != ZR_PROJECTION_ORTHOGRAPHIC) return;
    view->xmag = 1.0f / own->projection.m[0];
    view->ymag = 1.0f / own->projection.m[5];
}

/* Takes all but the depths from `own`. */
static void copy_rows(const struct zr_camera *own, struct zr_camera *camera)
{
    camera->world_to_eye = own->world_to_eye;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 2; row++)
            camera->projection.m[4 * column + row] = own->projection.m[4 * column + row];
}

static enum zr_status report(const struct zr_flow *flow, enum zr_status status, const struct zr_error *faults,
                             struct zr_error *error)
{
    char at[ZR_POINTER_SIZE];
    for (size_t i = 0; i < zr_error_held(faults); i++) {
        snprintf(at, sizeof at, "/outputs/%u/to%.100s", flow->output, faults->items[i].pointer);
        zr_error_add(error, status, at, "%s", faults->items[i].detail);
    }
    return status;
}

enum zr_status zr_flow_camera_find(const struct zr_run *run, const struct zr_scene *scene, const struct zr_camera *own,
                                   struct zr_camera *camera)
{
    const struct zr_flow *flow = scene->flow;
    struct zr_error faults = {0};
    struct zr_scene moved;
    *camera = *own;
    if (!flow) return ZR_OK;
    if (!zr_flow_scene(run->arena, scene, &moved)) return ZR_NO_MEMORY;
    struct zr_view *view = &moved.views[0];
    if (flow->has_view) {
        const struct zr_view given = *view;
        *view = flow->view;
        view->width = given.width;
        view->height = given.height;
        view->output_count = 0;
    } else {
        use_camera(own, view);
    }
    const struct zr_bounds bounds = zr_bounds_of(&moved, run->team, run->cancel);
    const struct zr_run finding = zr_run_reporting(run, &faults);
    const enum zr_status status = zr_camera_resolve(&finding, &moved, view, &bounds, camera);
    if (status != ZR_OK) return report(flow, status, &faults, run->error);
    if (!flow->has_view) copy_rows(own, camera);
    return ZR_OK;
}
