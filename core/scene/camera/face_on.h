/* face_on.h - scene: the preset that shows a flat model face on. */
#ifndef ZR_FACE_ON_H
#define ZR_FACE_ON_H

#include "base/cancel.h"
#include "base/team.h"
#include "scene/camera/camera.h"

/* Finds the preset that shows a scene of bare meshes with these bounds face on. False unless one extent of its box is
 * below 1/25 of both others. Selects the side that shows the fronts of more faces; if the numbers are equal, the front,
 * the right side or the top. World space has y up. `team` and `cancel` may be NULL. */
bool zr_face_on_find(const struct zr_scene *scene, const struct zr_bounds *bounds, struct zr_team *team,
                     const struct zr_cancel *cancel, enum zr_preset *preset);

#endif
