#include "scene/camera/rays.h"

#include "base/matrix.h"

struct homogeneous {
    double v[4];
};

static struct homogeneous eye_point(const struct zr_matrix *clip_to_eye, double x, double y, double z)
{
    const double clip[4] = {x, y, z, 1.0};
    struct homogeneous out;
    zr_matrix_apply(clip_to_eye, clip, out.v);
    return out;
}

static zr_vec3 vec3_of(const double v[3])
{
    return (zr_vec3){(float)v[0], (float)v[1], (float)v[2]};
}

/* Finds an affine function of the window from its values at the lower left, lower right and upper left corner: the
 * first value and its changes per pixel. */
static void spread(const double at[3], const double right[3], const double top[3], double width, double height,
                   zr_vec3 *value, zr_vec3 *along_x, zr_vec3 *along_y)
{
    double x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = (right[k] - at[k]) / width;
        y[k] = (top[k] - at[k]) / height;
    }
    *value = vec3_of(at);
    *along_x = vec3_of(x);
    *along_y = vec3_of(y);
}

/* Finds the ray of a corner: its direction times w, which is linear over the window, or for parallel rays its point on
 * the near plane. */
static void corner_of(const struct zr_matrix *clip_to_eye, zr_vec4 eye, double x, double y, double out[3])
{
    const struct homogeneous p = eye_point(clip_to_eye, x, y, eye.w != 0.0f ? 1.0 : -1.0);
    const double from[3] = {(double)eye.x, (double)eye.y, (double)eye.z};
    for (int k = 0; k < 3; k++)
        out[k] = eye.w != 0.0f ? p.v[k] - from[k] * p.v[3] : p.v[k] / p.v[3];
}

bool zr_rays_of(const struct zr_camera *camera, uint32_t width, uint32_t height, struct zr_rays *rays)
{
    const struct zr_matrix projection = zr_matrix_of(&camera->projection);
    const zr_vec4 eye = zr_camera_eye(camera);
    struct zr_matrix back;
    double at[3], right[3], top[3];
    if (!zr_matrix_invert(&projection, &back)) return false;
    corner_of(&back, eye, -1.0, -1.0, at);
    corner_of(&back, eye, 1.0, -1.0, right);
    corner_of(&back, eye, -1.0, 1.0, top);
    *rays = (struct zr_rays){.origin = {eye.x, eye.y, eye.z}};
    if (eye.w != 0.0f) {
        spread(at, right, top, (double)width, (double)height, &rays->direction, &rays->direction_x, &rays->direction_y);
    } else {
        rays->direction = (zr_vec3){-eye.x, -eye.y, -eye.z};
        spread(at, right, top, (double)width, (double)height, &rays->origin, &rays->origin_x, &rays->origin_y);
    }
    return true;
}
