/* sectioned_view.h - sections: the view of a scene. With sections, it frames the remaining part.
 *
 * How:    the view is resolved for the whole scene, which decides the planes and the direction of the camera. Triangles
 *         are clipped by the planes (Sutherland & Hodgman, "Reentrant polygon clipping", 1974), and the view is fitted
 *         to the remaining corners. Caps lie within their hull.
 * Else:   the camera of the whole scene stays if the view has an eye, a distance, a mesh of its own to fit or dimensions
 *         of the whole box, if parts stay uncut, and if the far side of a plane would be the other one. The bounds are
 *         those of the whole scene.
 */
#ifndef ZR_SECTIONED_VIEW_H
#define ZR_SECTIONED_VIEW_H

#include "scene/camera/resolved_view.h" /* zr_resolved_view_find is in core.h */

#endif
