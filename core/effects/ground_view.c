#include "effects/ground_view.h"

#include "shade/lights/lamps.h"

/* Plane through the lowest point of the bounds: its middle and its axes, in world space. */
struct plane {
    zr_vec3 middle, x, y, up;
    float half_size, height; /* half the side of the map; height of the scene over the plane */
};

static struct plane plane_under(const struct zr_scene *scene, const struct zr_bounds *bounds)
{
    const zr_vec3 min = bounds->min, max = bounds->max, size = zr_vec3_sub(max, min);
    const bool z_is_up = scene->picture.z_is_up;
    struct plane plane = {.middle = zr_vec3_scale(zr_vec3_add(min, max), 0.5f),
                          .x = {1, 0, 0},
                          .y = z_is_up ? (zr_vec3){0, 1, 0} : (zr_vec3){0, 0, -1},
                          .up = zr_scene_up(scene),
                          .height = z_is_up ? size.z : size.y};
    const float depth = z_is_up ? size.y : size.z, widest = size.x > depth ? size.x : depth;
    if (z_is_up)
        plane.middle.z = min.z;
    else
        plane.middle.y = min.y;
    plane.half_size = 0.5f * widest + 0.3f * zr_diagonal_of(bounds);
    return plane;
}

/* Returns a world-space unit vector in eye space, scaled so that its dot product measures scene units. */
static zr_vec3 axis_in(const zr_mat4 *m, zr_vec3 axis, float scale)
{
    const zr_vec3 v = zr_mat4_direction(m, axis);
    return scale == 1.0f ? v : zr_vec3_scale(v, 1.0f / (scale * scale));
}

static struct zr_ground_frame frame_of(const struct plane *plane, const struct zr_camera *camera)
{
    const zr_mat4 *m = &camera->world_to_eye;
    const float scale = zr_eye_scale_of(camera);
    const zr_vec4 middle = zr_mat4_apply(m, (zr_vec4){plane->middle.x, plane->middle.y, plane->middle.z, 1.0f});
    return (struct zr_ground_frame){.origin = {middle.x, middle.y, middle.z},
                                    .x_axis = axis_in(m, plane->x, scale),
                                    .y_axis = axis_in(m, plane->y, scale),
                                    .z_axis = zr_mat4_direction(m, plane->up)};
}

/* True if the eye, or the direction towards it, is above the plane. */
static bool is_above(const struct zr_camera *camera, const struct zr_ground_frame *frame)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    zr_vec3 place = {eye.x, eye.y, eye.z};
    if (eye.w != 0.0f) place = zr_vec3_sub(place, frame->origin);
    return zr_vec3_dot(place, frame->z_axis) > 0.0f;
}

/* The camera below has the up direction -y, so that rows of the map, from the top, run along the plane's y. */
bool zr_ground_view_find(const struct zr_scene *scene, const struct zr_camera *camera, const struct zr_bounds *bounds,
                         struct zr_ground_view *view)
{
    const float diagonal = zr_diagonal_of(bounds), margin = 0.01f * diagonal;
    if (!(diagonal > 0.0f)) return false;
    const struct plane plane = plane_under(scene, bounds);
    view->frame = frame_of(&plane, camera);
    view->half_size = plane.half_size;
    view->below = zr_camera_orthographic(plane.x, zr_vec3_scale(plane.y, -1.0f), zr_vec3_scale(plane.up, -1.0f),
                                         plane.middle, plane.half_size, -margin, plane.height + margin);
    return is_above(camera, &view->frame);
}
