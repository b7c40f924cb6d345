/* point_spacing.h - scene: the distance of neighbouring points, and the size at which points of a cloud meet. */
#ifndef ZR_POINT_SPACING_H
#define ZR_POINT_SPACING_H

#include "base/arena.h"
#include "base/team.h"
#include "scene/scene.h"

/* Returns the point size in pixels for a cloud that is fitted into the view: the spacing of the points of all meshes,
 * at the scale at which the diagonal of their box fills the smaller side of the window, times 1.5. At least 1, at most
 * 1/40 of the smaller side, or 64. Returns 1 without points, without memory and if cancelled.
 *
 * The points lie on a surface: with n of the cells of a grid occupied by N points, the spacing is the side of a cell
 * times sqrt(n / N). The grid is the finest of 128, 64, ... cells per side with N >= 4 n. */
float zr_point_size_for(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                        const struct zr_view *view);

#endif
