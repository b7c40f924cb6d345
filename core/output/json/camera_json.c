#include "output/json/camera_json.h"

#include "base/matrix.h"
#include "scene/camera/camera.h"

/* Prints the pinhole intrinsics in pixels, (0, 0) at the top left corner, if the camera is a pinhole. */
static void print_intrinsics(struct zr_print *print, const struct zr_frame *frame)
{
    const float *p = frame->camera.projection.m;
    if (p[3] != 0.0f || p[7] != 0.0f || p[11] != -1.0f || p[15] != 0.0f) return;
    double x = (double)frame->width * 0.5, y = (double)frame->height * 0.5;
    double skew = 0.0 - (double)p[4], lean = 0.0 - (double)p[1]; /* subtracted from zero, so that no zero becomes -0 */
    const float rows[3][3] = {{(float)((double)p[0] * x), (float)(skew * x), (float)((1.0 - (double)p[8]) * x)},
                              {(float)(lean * y), (float)((double)p[5] * y), (float)((1.0 + (double)p[9]) * y)},
                              {0.0f, 0.0f, 1.0f}};
    zr_print_begin(print, "K", '[');
    for (int i = 0; i < 3; i++)
        zr_print_floats(print, NULL, rows[i], 3);
    zr_print_end(print, ']');
}

/* Prints the lens as a view gives it. */
static void print_lens(struct zr_print *print, const struct zr_lens *lens)
{
    const bool is_fisheye = lens->model == ZR_LENS_FISHEYE;
    if (lens->model == ZR_LENS_NONE) return;
    zr_print_begin(print, "distortion", '{');
    zr_print_string(print, "model", is_fisheye ? "fisheye" : "opencv");
    zr_print_doubles(print, "k", lens->k, is_fisheye ? 4 : 6);
    if (!is_fisheye) zr_print_doubles(print, "p", lens->p, 2);
    zr_print_end(print, '}');
}

/* Prints the direction of the view in angles, for readers. */
static void print_orbit(struct zr_print *print, const struct zr_camera *camera, bool z_is_up, const double *moved)
{
    const struct zr_orbit orbit = zr_orbit_of(camera, z_is_up);
    zr_print_string(print, "up", z_is_up ? "z" : "y");
    if (orbit.has_angles) {
        zr_print_float(print, "azimuthDegrees", (float)orbit.azimuth_degrees);
        zr_print_float(print, "elevationDegrees", (float)orbit.elevation_degrees);
    }
    if (orbit.has_eye) zr_print_place(print, "eye", orbit.eye, moved);
}

void zr_camera_print_pose(struct zr_print *print, const struct zr_camera *camera, const double *moved)
{
    struct zr_matrix pose = zr_matrix_of(&camera->world_to_eye);
    double *m = pose.m;
    if (!moved) {
        zr_print_floats(print, "worldToCamera", camera->world_to_eye.m, 16);
        return;
    }
    for (int row = 0; row < 3; row++)
        m[12 + row] -= m[row] * moved[0] + m[4 + row] * moved[1] + m[8 + row] * moved[2];
    zr_print_doubles(print, "worldToCamera", m, 16);
}

void zr_camera_print(struct zr_print *print, const struct zr_frame *frame, bool z_is_up)
{
    const struct zr_camera *camera = &frame->camera;
    zr_print_begin(print, "camera", '{');
    zr_camera_print_pose(print, camera, frame->origin);
    zr_print_floats(print, "projectionMatrix", camera->projection.m, 16);
    print_intrinsics(print, frame);
    print_lens(print, &frame->view->lens);
    if (camera->znear != 0.0f || camera->zfar != 0.0f) {
        zr_print_float(print, "znear", camera->znear);
        zr_print_float(print, "zfar", camera->zfar);
    }
    print_orbit(print, camera, z_is_up, frame->origin);
    zr_print_end(print, '}');
}
