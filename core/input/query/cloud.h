/* cloud.h - input: edges, colour and size of the points and lines of bare meshes. */
#ifndef ZR_CLOUD_H
#define ZR_CLOUD_H

#include "input/query/parameters.h"

/* Removes the look's edges if the scene has only points, since a line around each point would hide it.
 * Returns true if it removed them. */
bool zr_cloud_take_edges(struct zr_parsed_scene *root);

/* Gives points without a colour the colour of the edges, unless the look's surfaces are of the shading pbr: the base
 * colour of other looks with edges may be the background's. */
void zr_cloud_draw_in_ink(const struct zr_query *query);

/* Gives lines without a colour, in scenes without faces, the colour that the look has for them (zr_look.wire). */
void zr_wire_color(const struct zr_query *query);

/* Replaces point sizes of 0 by a size that follows from the density of the points. Makes points round in looks with
 * several samples per pixel. Requires meshes in object space and a closed builder. */
void zr_cloud_size_points(const struct zr_query *query);

/* Returns the point size in pixels for a cloud that is fitted into the view: 1.5 times the spacing of the points of
 * all meshes. At its scale, the diagonal of their box fills the smaller side of the window. The size is at most 64 and
 * at most 1/40 of that side, but at least 1. Returns 1 without points, without memory and if cancelled.
 *
 * The points lie on a surface: with n of the cells of a grid occupied by N points, the spacing is the side of a cell
 * times sqrt(n / N). The grid is the finest of 128, 64, ... cells per side with N >= 4 n. */
float zr_point_size_for(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                        const struct zr_view *view);

#endif
