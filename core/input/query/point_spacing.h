/* point_spacing.h - input: the distance of neighbouring points, and the point size at which they touch. */
#ifndef ZR_POINT_SPACING_H
#define ZR_POINT_SPACING_H

#include "base/arena.h"
#include "base/team.h"
#include "scene/scene.h"

/* Returns the point size in pixels for a cloud that is fitted into the view: 1.5 times the spacing of the points of
 * all meshes. At its scale, the diagonal of their box fills the smaller side of the window. The size is at most 64 and
 * at most 1/40 of that side, but at least 1. Returns 1 without points, without memory and if cancelled.
 *
 * The points lie on a surface: with n of the cells of a grid occupied by N points, the spacing is the side of a cell
 * times sqrt(n / N). The grid is the finest of 128, 64, ... cells per side with N >= 4 n. */
float zr_point_size_for(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                        const struct zr_view *view);

#endif
