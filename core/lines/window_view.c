#include "lines/window_view.h"

/* Returns the factor of z/w: pixels per unit of eye space across the view, over the change of z/w per unit along it,
 * both at `at`. 0 if the projection has no depth there. */
static double depth_scale_of(const struct zr_matrix *m, const double at[4], double width)
{
    double clip[4];
    zr_matrix_apply(m, at, clip);
    const double w = clip[3], across = (m->m[0] * w - clip[0] * m->m[3]) * 0.5 * width;
    const double along = m->m[11] * clip[2] - m->m[10] * w; /* of -z, which grows away from the eye */
    return fabs(along) > 0.0 && isfinite(across / along) ? fabs(across) / along : 0.0;
}

static double diagonal_of(const struct zr_bounds *bounds)
{
    const double x = (double)bounds->max.x - (double)bounds->min.x, y = (double)bounds->max.y - (double)bounds->min.y,
                 z = (double)bounds->max.z - (double)bounds->min.z;
    return bounds->valid ? sqrt((x * x + y * y) + z * z) : 0.0;
}

/* Returns the diagonal of the rectangle around the bounds in the window; HUGE_VAL if they reach behind the eye. */
static double seen_diagonal_of(const struct zr_window_view *view, const struct zr_bounds *bounds)
{
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (unsigned corner = 0; corner < 8; corner++) {
        const double world[4] = {(double)(corner & 1 ? bounds->max.x : bounds->min.x),
                                 (double)(corner & 2 ? bounds->max.y : bounds->min.y),
                                 (double)(corner & 4 ? bounds->max.z : bounds->min.z), 1.0};
        double eye[4], clip[4];
        zr_matrix_apply(&view->world_to_eye, world, eye);
        zr_matrix_apply(&view->eye_to_clip, eye, clip);
        if (!(clip[3] > 0.0)) return HUGE_VAL;
        const struct zr_window_point at = zr_window_point_of(view, clip);
        low[0] = fmin(low[0], at.x);
        low[1] = fmin(low[1], at.y);
        high[0] = fmax(high[0], at.x);
        high[1] = fmax(high[1], at.y);
    }
    return sqrt((high[0] - low[0]) * (high[0] - low[0]) + (high[1] - low[1]) * (high[1] - low[1]));
}

struct zr_window_view zr_window_view_make(const struct zr_camera *camera, const struct zr_bounds *bounds, double width,
                                          double height)
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
    if (view.depth_scale == 0.0) view.depth_scale = 0.5 * width;
    view.diagonal = diagonal_of(bounds) * (double)zr_eye_scale_of(camera);
    return view;
}

struct zr_window_view zr_window_view_refine(const struct zr_camera *camera, const struct zr_bounds *bounds,
                                            const struct zr_window_view *view)
{
    const double window = sqrt(view->width * view->width + view->height * view->height);
    const double seen = bounds->valid ? seen_diagonal_of(view, bounds) : 0.0;
    const double scale = fmin(ZR_FINE_DIAGONAL / (seen > 0.0 && seen < 2.0 * window ? seen : window),
                              ZR_FINE_SIDE / sqrt(view->width * view->height));
    return zr_window_view_make(camera, bounds, view->width * scale, view->height * scale);
}
