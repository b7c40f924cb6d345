/* lens_plan.h - scene: the pinhole picture behind a lens.
 *
 * A view through a lens is drawn as a pinhole picture with the same pose, whose window holds the rays of all pixels.
 * Then each pixel looks up its ray (effects/remap.h).
 * Scale:  pixels of the pinhole picture are as fine as those of the view at the largest magnification of the lens, and
 *         at least as fine as those of the view's own pinhole. The centre of the nearest pixel lies within 0.71 pixels.
 */
#ifndef ZR_LENS_PLAN_H
#define ZR_LENS_PLAN_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/run.h"
#include "base/status.h"
#include "scene/camera/camera.h"
#include "scene/camera/lens.h"
#include "scene/scene.h"

/* Limits of the pinhole picture. */
#define ZR_LENS_SIDE_MAX   8192
#define ZR_LENS_PIXELS_MAX (UINT64_C(32) * 1024 * 1024)

struct zr_lens_plan {
    struct zr_lens_inverse inverse;
    struct zr_intrinsics intrinsics; /* of the view, complete */
    uint32_t view_width, view_height;
    uint32_t width, height; /* of the pinhole picture */
    double scale;           /* pixels of the pinhole picture per pixel of the view, at least 1 */
    double left, top;       /* its upper left corner, in its pixels from that of the view */
};

/* Plans the picture of a view with a lens. Errors: ZR_BAD_SCENE if a ray is farther than ZR_LENS_DEGREES_MAX from the
 * axis, or if the picture is too large; ZR_NO_MEMORY; ZR_CANCELLED. */
enum zr_status zr_lens_plan_make(const struct zr_run *run, const struct zr_view *view,
                                 const struct zr_lens_plan **plan);

/* Returns the camera of the pinhole picture. `camera` is that of the view. */
struct zr_camera zr_lens_pinhole(const struct zr_lens_plan *plan, const struct zr_camera *camera);

/* Returns the ray of a point of the view, in pixels from its upper left corner. Its x and y are pixels of the pinhole
 * picture, and its derivatives are not set. */
struct zr_lens_ray zr_lens_look_up(const struct zr_lens_plan *plan, double x, double y);

#endif
