#include "lines/window_view.h"

/* Returns the factor of z/w: pixels per unit of eye space across the view, over the change of z/w per unit along it,
 * both at `at`. 0 if the projection has no depth there. */
static double depth_scale_of(const struct zr_matrix *m, const double at[4], uint32_t width)
{
    double clip[4];
    zr_matrix_apply(m, at, clip);
    const double w = clip[3], across = (m->m[0] * w - clip[0] * m->m[3]) * 0.5 * (double)width;
    const double along = m->m[11] * clip[2] - m->m[10] * w; /* of -z, which grows away from the eye */
    return fabs(along) > 0.0 && isfinite(across / along) ? fabs(across) / along : 0.0;
}

struct zr_window_view zr_window_view_make(const struct zr_camera *camera, const struct zr_bounds *bounds,
                                          uint32_t width, uint32_t height)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    struct zr_window_view view = {.width = width,
                                  .height = height,
                                  .world_to_eye = zr_matrix_of(&camera->world_to_eye),
                                  .eye_to_clip = zr_matrix_of(&camera->projection),
                                  .eye = {(double)eye.x, (double)eye.y, (double)eye.z, (double)eye.w}};
    const double middle[4] = {bounds->valid ? 0.5 * ((double)bounds->min.x + (double)bounds->max.x) : 0.0,
                              bounds->valid ? 0.5 * ((double)bounds->min.y + (double)bounds->max.y) : 0.0,
                              bounds->valid ? 0.5 * ((double)bounds->min.z + (double)bounds->max.z) : 0.0, 1.0};
    double at[4];
    zr_matrix_apply(&view.world_to_eye, middle, at);
    view.depth_scale = depth_scale_of(&view.eye_to_clip, at, width);
    if (view.depth_scale == 0.0) view.depth_scale = 0.5 * (double)width;
    return view;
}
