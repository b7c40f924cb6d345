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

/* Returns the factor by which the upper 3x3 scales lengths; 0 if it depends on the direction. Factors within 0.001 of 1
 * come from rounding and give 1. */
double zr_pose_matrix_scale(const zr_mat4 *world_to_eye);

/* Adds a warning for a reflection, and one for a scaling matrix if outputs hold eye-space lengths, which are then not
 * in scene units. */
void zr_pose_matrix_warn(struct zr_arena *arena, const struct zr_view *view, struct zr_warning_list *warnings);

#endif
