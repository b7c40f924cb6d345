/* defaults.h - scene: the values of a scene that gives none of its own. */
#ifndef ZR_DEFAULTS_H
#define ZR_DEFAULTS_H

#include <stdbool.h>

#include "scene/looks.h"

#define ZR_YFOV 0.78539816f /* of perspective views that scenes ask for, radians: 45 degrees */

/* Window 640x480, a colour image as the one output, no geometry, and the look textbook. */
void zr_scene_defaults(struct zr_scene *scene);

/* The ambient light of a scene that says which lights it has. */
zr_vec3 zr_default_ambient_of_own_lights(void);

/* The colour of what has no material: the look's, or, where it has colours of its own, white, which leaves them as they
 * are. */
zr_vec4 zr_default_base_color(const struct zr_look *look, bool coloured);

/* The look's; by the textbook smooth where normals or vertex colours ask for it. */
enum zr_shading zr_default_shading(const struct zr_look *look, bool smooth);

#endif
