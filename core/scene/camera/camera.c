#include "scene/camera/camera.h"

#include <math.h>

#include "base/matrix.h"

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

/* The eye of a projection: the homogeneous point whose clip-space x, y and w are 0. */
struct eye {
    double v[4];
    double farther; /* growth of clip-space z along x, y and z of v */
    double scale;   /* v / scale is the eye, or the direction towards it for parallel rays; 0: no eye */
};

/* Applies Cramer's rule. */
static struct eye solve_eye(const zr_mat4 *projection)
{
    static const int of_clip[3] = {0, 1, 3};
    const float *p = projection->m;
    double rows[3][4];
    struct eye eye;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            rows[row][column] = (double)p[4 * column + of_clip[row]];
    double *v = eye.v;
    for (int k = 0; k < 4; k++)
        v[k] = (k % 2 ? -1.0 : 1.0) * minor_of(rows, k);
    const double length = sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
    eye.farther = ((double)p[2] * v[0] + (double)p[6] * v[1]) + (double)p[10] * v[2];
    eye.scale = v[3] != 0.0 ? v[3] : eye.farther > 0.0 ? -length : length;
    return eye;
}

zr_vec4 zr_camera_eye(const struct zr_camera *camera)
{
    const zr_vec4 origin = {0, 0, 0, 1};
    const struct eye solved = solve_eye(&camera->projection);
    const double *v = solved.v, scale = solved.scale;
    if (scale == 0.0) return origin;
    const zr_vec4 eye = {(float)(v[0] / scale), (float)(v[1] / scale), (float)(v[2] / scale),
                         v[3] != 0.0 ? 1.0f : 0.0f};
    return isfinite(eye.x) && isfinite(eye.y) && isfinite(eye.z) ? eye : origin;
}

bool zr_projection_is_mirror(const zr_mat4 *projection)
{
    const struct eye eye = solve_eye(projection);
    return eye.v[3] != 0.0 ? eye.v[3] < 0.0 : eye.farther > 0.0 && eye.v[2] < 0.0;
}

bool zr_projection_is_reversed(const zr_mat4 *projection)
{
    const struct eye eye = solve_eye(projection);
    const double determinant = eye.farther + (double)projection->m[14] * eye.v[3];
    return eye.v[3] != 0.0 && determinant * eye.v[3] > 0.0;
}

bool zr_camera_reverses_windings(const struct zr_camera *camera, const zr_mat4 *object_to_world)
{
    return (zr_mat4_is_mirror(&camera->world_to_eye) != zr_projection_is_mirror(&camera->projection)) !=
           zr_mat4_is_mirror(object_to_world);
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

static const double DEGREES = 180.0 / 3.14159265358979323846;

/* Rounds to 0.001, without -0: the last bits of libm differ between systems, and float matrices hold no more digits. */
static double rounded(double degrees)
{
    return round(degrees * 1000.0) / 1000.0 + 0.0;
}

/* Sets the angles of `back`, the world-space direction towards the camera. Its horizontal parts are `front` (azimuth 0)
 * and `right` (azimuth 90). */
static void set_angles(struct zr_orbit *orbit, const double back[4], bool z_is_up)
{
    const double right = back[0], front = z_is_up ? -back[1] : back[2], up = z_is_up ? back[2] : back[1];
    const double level = sqrt(right * right + front * front), length = sqrt(level * level + up * up);
    if (!(length > 0.0) || !isfinite(length)) return;
    orbit->has_angles = true;
    orbit->elevation_degrees = rounded(atan2(up, level) * DEGREES);
    if (level > 1e-6 * length) orbit->azimuth_degrees = rounded(atan2(right, front) * DEGREES);
    if (orbit->azimuth_degrees <= -180.0) orbit->azimuth_degrees = 180.0;
}

struct zr_orbit zr_orbit_of(const struct zr_camera *camera, bool z_is_up)
{
    struct zr_orbit orbit = {.has_angles = false};
    const struct zr_matrix world_to_eye = zr_matrix_of(&camera->world_to_eye);
    const zr_vec4 eye = zr_camera_eye(camera);
    const double backwards[4] = {0, 0, 1, 0}, place[4] = {(double)eye.x, (double)eye.y, (double)eye.z, 1};
    struct zr_matrix eye_to_world;
    double back[4], at[4];
    if (!zr_matrix_invert(&world_to_eye, &eye_to_world)) return orbit;
    zr_matrix_apply(&eye_to_world, backwards, back);
    set_angles(&orbit, back, z_is_up);
    zr_matrix_apply(&eye_to_world, place, at);
    orbit.eye = (zr_vec3){(float)(at[0] / at[3]), (float)(at[1] / at[3]), (float)(at[2] / at[3])};
    orbit.has_eye = eye.w != 0.0f && isfinite(orbit.eye.x) && isfinite(orbit.eye.y) && isfinite(orbit.eye.z);
    return orbit;
}
