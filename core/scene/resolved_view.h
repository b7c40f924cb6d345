/* resolved_view.h - scene, last step: a view (pose, projection, fit) -> a camera.
 *
 * Fits:   a pose that names no eye shows all of the geometry, or of one mesh of it; near
 *         and far plane hold all of it in any case.
 */
#ifndef ZR_RESOLVED_VIEW_H
#define ZR_RESOLVED_VIEW_H

#include "base/status.h"
#include "scene/camera.h"
#include "scene/scene.h"
#include "zraster.h"

/* What zr_resolved_view_find finds. */
struct zr_resolved_view {
    const struct zr_view *view;
    struct zr_bounds bounds; /* of the geometry; not valid where neither the view nor an output needs them */
    struct zr_camera camera;
};

/* `bounds` need not be defined where the view does not need them. Fails with ZR_BAD_SCENE where the view has no
 * solution (an eye on its target, an up along the view, a target that a fitted distance cannot show), where an entry
 * of a matrix is beyond ZR_MATRIX_MAX, or where zr_view_warns and the scene is strict. */
enum zr_status zr_camera_resolve(const struct zr_scene *scene, const struct zr_view *view,
                                 const struct zr_bounds *bounds, struct zr_team *team, const struct zr_cancel *cancel,
                                 struct zr_camera *camera, struct zr_error *error);

/* What is odd about the view, into `text`. False: nothing is. */
enum { ZR_VIEW_WARNING_SIZE = 160 };
bool zr_view_warns(const struct zr_camera *camera, char text[ZR_VIEW_WARNING_SIZE]);

#endif
