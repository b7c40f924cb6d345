/* window_view.h - lines: the map from eye space to the window in which lines are found.
 *
 * Space:  x and y in pixels, y up, as in geometry/viewport.h. z is affine in the window: z/w of clip space, scaled so
 *         that one unit is a pixel at the middle of the bounds. It grows away from the eye. Slopes of depth are thus
 *         pixels per pixel, in perspective too.
 * Fine:   lines are found in a window of the same camera in which 2048 pixels are the diagonal of the rectangle around
 *         the bounds; in views of a detail, where that is longer than twice the diagonal of the window, that of the
 *         window. The lines of a drawing are thus the same ones in windows of all sizes. The sides of the fine window
 *         are no whole numbers, and its area is at most 4096 x 4096 pixels.
 * Exact:  doubles, in a stated order. */
#ifndef ZR_WINDOW_VIEW_H
#define ZR_WINDOW_VIEW_H

#include "base/matrix.h"
#include "scene/camera/camera.h"

enum { ZR_FINE_DIAGONAL = 2048, ZR_FINE_SIDE = 4096 /* pixels */ };

struct zr_window_point {
    double x, y, z;
};

struct zr_window_view {
    double width, height; /* pixels */
    struct zr_matrix world_to_eye, eye_to_clip;
    double eye[4]; /* centre of projection in eye space; w = 0: the direction towards it */
    double depth_scale;
    double diagonal; /* of the bounds, in eye space */
};

struct zr_window_view zr_window_view_make(const struct zr_camera *camera, const struct zr_bounds *bounds, double width,
                                          double height);

/* Returns the fine view of the camera, for the window of another view. */
struct zr_window_view zr_window_view_refine(const struct zr_camera *camera, const struct zr_bounds *bounds,
                                            const struct zr_window_view *view);

/* Planes of the view volume that a point in clip space is outside of. */
enum { ZR_OUTSIDE_NEAR = 1, ZR_OUTSIDE_FAR = 2, ZR_OUTSIDE_EYE = 4 };

static inline unsigned zr_window_outside(const double clip[4])
{
    const unsigned near = clip[2] >= -clip[3] ? 0 : ZR_OUTSIDE_NEAR, far = clip[2] <= clip[3] ? 0 : ZR_OUTSIDE_FAR;
    return near | far | (clip[3] > 0.0 ? 0 : ZR_OUTSIDE_EYE);
}

/* Returns the window position of a point inside the volume. */
static inline struct zr_window_point zr_window_point_of(const struct zr_window_view *view, const double clip[4])
{
    const double over_w = 1.0 / clip[3];
    return (struct zr_window_point){(clip[0] * over_w + 1.0) * 0.5 * view->width,
                                    (clip[1] * over_w + 1.0) * 0.5 * view->height,
                                    clip[2] * over_w * view->depth_scale};
}

#endif
