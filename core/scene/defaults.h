/* defaults.h - scene: default values of a scene. */
#ifndef ZR_DEFAULTS_H
#define ZR_DEFAULTS_H

#include <stdbool.h>

#include "scene/looks.h"

#define ZR_YFOV 0.78539816f /* default yfov of a scene's perspective view, radians: 45 degrees */

/* Window, in pixels. */
#define ZR_DEFAULT_WIDTH  640
#define ZR_DEFAULT_HEIGHT 480

/* Sets a scene without geometry: the default window, one output, color as PNG, and the look textbook. */
void zr_scene_defaults(struct zr_scene *scene);

/* Replaces the default output color by info if nothing is drawn. Called once all keys are read. */
void zr_default_output_use(struct zr_scene *scene);

/* True if the outputs of the first view are pictures: the channel color, or none given. */
bool zr_outputs_are_pictures(const struct zr_scene *scene);

/* Returns the ambient light of a scene that gives `lights` but no `ambient`. */
zr_vec3 zr_default_ambient_of_own_lights(void);

/* Returns the base colour of a mesh without a material: white, which leaves colours unchanged, if it is `coloured`,
 * else the look's. */
zr_vec4 zr_default_base_color(const struct zr_look *look, bool coloured);

/* Returns the look's shading. A look that shades_by_mesh uses gouraud if `smooth` (normals or vertex colours), else
 * flat. */
enum zr_shading zr_default_shading(const struct zr_look *look, bool smooth);

#endif
