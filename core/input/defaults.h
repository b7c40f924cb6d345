/* defaults.h - input: what a scene is where nobody says otherwise. */
#ifndef ZR_DEFAULTS_H
#define ZR_DEFAULTS_H

#include <stdbool.h>

#include "scene/scene.h"

#define ZR_FIT_PADDING 0.05f
#define ZR_SHININESS   32.0f
#define ZR_YFOV        0.78539816f /* of perspective views, radians: 45 degrees */

/* Window 640x480, white background, ambient light and two that go with the camera, an isometric
 * view fitted to the geometry, a colour image as the one output; no geometry. */
void zr_scene_defaults(struct zr_scene *scene);

/* The ambient light of a scene that says which lights it has. */
zr_vec3 zr_default_ambient_of_own_lights(void);

/* The colour of what has no material: grey, or, where it has colours of its own, white, which leaves them as they
 * are. */
zr_vec4 zr_default_base_color(bool coloured);

/* Smooth where normals or vertex colours ask for it. */
enum zr_shading zr_default_shading(bool smooth);

#endif
