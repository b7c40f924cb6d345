/* texcoords.h - shade: texture coordinates of the vertices of a mesh, before they are interpolated.
 *
 * Why:  files may have coordinates of any finite size, but floats resolve texels only near 0. An image that repeats looks
 *       the same a whole number of repeats away: that number is taken off in doubles, once for a mesh.
 */
#ifndef ZR_TEXCOORDS_H
#define ZR_TEXCOORDS_H

#include "scene/scene.h"

/* True if floats may not resolve the texels at some coordinate of the mesh. */
bool zr_texcoords_are_far(const struct zr_mesh *mesh);

/* Returns the coordinates of a mesh from which whole repeats may be taken before any texture of the material transforms
 * them: bits 0 to 3 for u and v of texcoord 0 and of texcoord 1. */
unsigned zr_texcoords_repeat(const struct zr_scene *scene, const struct zr_material *material);

/* Writes position_count coordinates, transformed for `texture`; NULL: as in the mesh, less whole repeats of those of
 * `repeat`. Magnitudes are at most 1e12. */
void zr_texcoords_put(const struct zr_mesh *mesh, const struct zr_texture *texture, unsigned repeat, zr_vec4 *out);

#endif
