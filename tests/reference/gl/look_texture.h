/* look_texture.h - reference: what the program of linear light needs of each corner to look at textures.
 *
 * Tangents, given or derived from positions and texture coordinates, and how the coordinates over w change along x and
 * y of the window: solved for each triangle in double, from its corners in clip space.
 */
#ifndef ZR_TEST_LOOK_TEXTURE_H
#define ZR_TEST_LOOK_TEXTURE_H

#include "base/arena.h"
#include "reference/gl/reference.h"

/* One a corner. */
struct look_corners {
    zr_vec4 *tangents;          /* object space, and the sign of the bitangent in eye space */
    zr_vec4 *along_x, *along_y; /* of both coordinates over w, a pixel */
    zr_vec4 *w_along;           /* x, y: of 1/w */
};

/* False where the arena has failed. */
bool look_corners_make(struct zr_arena *arena, const struct zr_scene *scene, const struct reference_arrays *arrays,
                       struct look_corners *out);

#endif
