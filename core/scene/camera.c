#include "scene/camera.h"

#include <math.h>

/* Returns the determinant of the 3 rows without column `left_out`. */
static double minor_of(double (*rows)[4], int left_out)
{
    double m[3][3];
    for (int row = 0; row < 3; row++)
        for (int column = 0, k = 0; column < 4; column++)
            if (column != left_out) m[row][k++] = rows[row][column];
    return (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Solves for the homogeneous point whose clip-space x, y and w are 0, by Cramer's rule. */
zr_vec4 zr_camera_eye(const struct zr_camera *camera)
{
    static const int of_clip[3] = {0, 1, 3};
    const float *p = camera->projection.m;
    const zr_vec4 origin = {0, 0, 0, 1};
    double rows[3][4], v[4], scale;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            rows[row][column] = (double)p[4 * column + of_clip[row]];
    for (int k = 0; k < 4; k++)
        v[k] = (k % 2 ? -1.0 : 1.0) * minor_of(rows, k);
    const double length = sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
    const double farther = ((double)p[2] * v[0] + (double)p[6] * v[1]) + (double)p[10] * v[2];
    if (v[3] != 0.0)
        scale = v[3];
    else if (length > 0.0)
        scale = farther > 0.0 ? -length : length;
    else
        return origin;
    const zr_vec4 eye = {(float)(v[0] / scale), (float)(v[1] / scale), (float)(v[2] / scale),
                         v[3] != 0.0 ? 1.0f : 0.0f};
    return isfinite(eye.x) && isfinite(eye.y) && isfinite(eye.z) ? eye : origin;
}

/* Measures the image of the y axis. Scales within 0.001 of 1 come from rounding and count as 1. */
float zr_eye_scale_of(const struct zr_camera *camera)
{
    const float *m = camera->world_to_eye.m;
    const zr_vec3 up = {m[4], m[5], m[6]};
    const float scale = sqrtf(zr_vec3_dot(up, up));
    return fabsf(scale - 1.0f) < 1e-3f || !(scale > 0.0f) ? 1.0f : scale;
}

float zr_diagonal_of(const struct zr_bounds *bounds)
{
    if (!bounds->valid) return 0.0f;
    const zr_vec3 size = zr_vec3_sub(bounds->max, bounds->min);
    return sqrtf(zr_vec3_dot(size, size));
}

struct zr_camera zr_camera_orthographic(zr_vec3 right, zr_vec3 up, zr_vec3 back, zr_vec3 eye, float half_size,
                                        float near, float far)
{
    struct zr_camera camera = {.znear = near, .zfar = far};
    camera.world_to_eye = (zr_mat4){{right.x, up.x, back.x, 0, right.y, up.y, back.y, 0, right.z, up.z, back.z, 0,
                                     -zr_vec3_dot(right, eye), -zr_vec3_dot(up, eye), -zr_vec3_dot(back, eye), 1}};
    camera.projection = (zr_mat4){{1.0f / half_size, 0, 0, 0, 0, 1.0f / half_size, 0, 0, 0, 0, 2.0f / (near - far), 0,
                                   0, 0, (far + near) / (near - far), 1}};
    return camera;
}
