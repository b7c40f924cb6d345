/* hatch.h - sections: the hatch of caps, as a texture of stripes.
 *
 * Space:  coordinates follow from places in the world, in double: u grows by 1 from line to line, and v is 0.
 * Lines:  at 45 degrees to the axis e1 = up x n of the plane, or at 135 degrees, by the number of the part; up is the
 *         scene's, or the axis behind it if the plane is nearly level. The pitch is one of three, by the number, too.
 */
#ifndef ZR_HATCH_H
#define ZR_HATCH_H

#include "base/arena.h"
#include "scene/scene.h"
#include "sections/section_planes.h"

/* Returns 1 + the number that the texture gets in a copy of the scene. */
uint32_t zr_hatch_texture(const struct zr_scene *scene);

/* Appends image and texture to the lists of a copy of a scene. False: the arena has no memory. */
bool zr_hatch_add(struct zr_arena *arena, struct zr_scene *scene);

/* Sets texcoords[p] for the positions of a face, placed by the matrix. `pitch`: distance of lines, world units. */
void zr_hatch_put(const struct zr_mesh *mesh, uint32_t face, const zr_mat4 *object_to_world,
                  const struct zr_section_plane *plane, bool z_is_up, uint64_t part, double pitch, zr_vec4 *texcoords);

#endif
