/* cloud.h - input: the picture of bare meshes that have points. */
#ifndef ZR_CLOUD_H
#define ZR_CLOUD_H

#include "input/parameters.h"

/* Removes the look's edges if the scene has points only: a line around each point would hide it. Returns true if it
 * did. */
bool zr_cloud_take_edges(struct zr_parsed_scene *root);

/* Gives points without a colour the colour of the edges: the base colour of looks with edges may be the background's.
 */
void zr_cloud_draw_in_ink(const struct zr_query *query);

/* Sets the size of points whose reader left it at 0, by their density, and makes them round in looks with several
 * samples per pixel. The meshes are in object space, and the builder is closed. */
void zr_cloud_size_points(const struct zr_query *query);

#endif
