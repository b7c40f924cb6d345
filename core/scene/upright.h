/* upright.h - scene: views of scenes whose z axis points up. */
#ifndef ZR_UPRIGHT_H
#define ZR_UPRIGHT_H

#include "scene/scene.h"

/* The view of a scene in which y is up becomes that of one in which z is: presets and angles are seen as in CAD, the
 * front being on -y, and z is up in the picture where the view did not say what is. */
void zr_view_put_z_up(struct zr_view *view, bool says_up);

#endif
