/* pose_matrix.h - scene: checks of a pose that is given as a matrix.
 *
 * Space:  world -> eye.
 * Source: a rigid motion keeps lengths and handedness: the upper 3x3 has rows of the length 1, at right angles, and a
 *         positive determinant.
 */
#ifndef ZR_POSE_MATRIX_H
#define ZR_POSE_MATRIX_H

#include "base/warning_list.h"
#include "scene/scene.h"

/* The one factor by which the upper 3x3 scales all lengths: 1 within 0.001, which is what rounding does to a rotation.
 * 0 where lengths depend on their direction. */
double zr_pose_matrix_scale(const zr_mat4 *world_to_eye);

/* Adds a warning for a reflection, and one for outputs whose distances such a matrix leaves in units that are not the
 * scene's. */
void zr_pose_matrix_warn(struct zr_arena *arena, const struct zr_view *view, struct zr_warning_list *warnings);

#endif
