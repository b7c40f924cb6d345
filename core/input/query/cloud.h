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

#endif
