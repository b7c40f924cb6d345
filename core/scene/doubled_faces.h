/* doubled_faces.h - scene: detection of faces that a mesh contains twice, once with each winding.
 *
 * Why:    the normals of two such faces add up to 0. A vertex with no other faces is left without a normal.
 * How:    hashes of faces, which change sign with the winding, are summed around each vertex. In meshes of more than
 * 256 positions, every 2nd, 4th, ... vertex is tested, about 256 in all.
 */
#ifndef ZR_DOUBLED_FACES_H
#define ZR_DOUBLED_FACES_H

#include "base/warning_list.h"
#include "scene/scene.h"

/* Adds one warning for meshes with such vertices whose averaged normals an output uses; it names the first mesh and
 * counts the others. Smooth shadings without linear light, and the channel normals, average over all faces of a
 * position. Linear light averages over all faces at a place, up to the crease angle: below 180 degrees the windings are
 * kept apart. Meshes with normals are left out. */
void zr_doubled_faces_warn(struct zr_arena *arena, const struct zr_scene *scene, struct zr_warning_list *warnings);

#endif
