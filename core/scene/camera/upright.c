#include "scene/camera/upright.h"

static const struct {
    double azimuth, elevation;
} presets[ZR_PRESET_COUNT] = {[ZR_PRESET_FRONT] = {0, 0},
                              [ZR_PRESET_BACK] = {180, 0},
                              [ZR_PRESET_LEFT] = {-90, 0},
                              [ZR_PRESET_RIGHT] = {90, 0},
                              [ZR_PRESET_TOP] = {0, 90},
                              [ZR_PRESET_BOTTOM] = {0, -90},
                              [ZR_PRESET_ISOMETRIC] = {45, 35.264389682754654}}; /* asin(1 / sqrt(3)) */

void zr_view_put_z_up(struct zr_view *view, bool has_up)
{
    const zr_vec3 d = zr_view_looks_along(view);
    if (view->pose == ZR_POSE_PRESET) {
        view->pose = ZR_POSE_ORBIT;
        view->azimuth_degrees = presets[view->preset].azimuth;
        view->elevation_degrees = presets[view->preset].elevation;
        view->has_target = false;
        view->distance = 0.0f;
    }
    if (has_up) return;
    view->up = (zr_vec3){0, 0, 1};
    /* Straight down and up: y as in the presets top and bottom. */
    if (d.x == 0.0f && d.y == 0.0f && d.z != 0.0f) view->up = (zr_vec3){0, d.z < 0.0f ? 1.0f : -1.0f, 0};
}
