/* crease_normals.h - mesh: corner normals, averaged over faces that meet at less than the crease angle.
 *
 * Space:  object space.
 * How:    the normal of a corner is a sum over the faces at its vertex that lie within the crease angle of its own
 *         face. Each face adds its unit normal times (area x corner angle). Vertices are welded if they lie within 1e-6
 *         of the diagonal of the mesh's bounds (weld.h). A face without area has no direction: its corners average all
 *         faces of the vertex. If the sum is 0, the corner gets the normal of its face. At a vertex with more than
 *         ZR_CREASE_EXACT corners, faces are summed in groups of similar directions. Corners are compared with the
 *         groups, which avoids quadratic cost. Fine meshes have a gentler rule at vertices whose faces differ by more
 *         than the crease angle (crease_fans.h), if that is 20 to 60 degrees.
 *         If the mesh has smoothing groups, they replace the crease angle: a corner averages all faces of its group at
 *         the vertex, and corners of group 0 get the normals of their faces.
 * Exact:  sums in the order of faces, for any number of threads; + - * / and sqrt only. */
#ifndef ZR_CREASE_NORMALS_H
#define ZR_CREASE_NORMALS_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "scene/scene.h"

/* Returns one unit normal per corner (slot of mesh->indices), with w = 0; 0 if no face of the vertex has an area.
 * `degrees`: 0..180; a face at exactly this angle counts. Takes about 25 bytes per position and 4 per corner of scratch
 * from the arena and gives them back; with smoothing groups, 8 per corner; crease_fans.h takes more. Returns NULL if
 * the arena failed. If cancelled, returns early with undefined normals. */
zr_vec4 *zr_crease_normals_make(const struct zr_run *run, const struct zr_mesh *mesh, float degrees);

#endif
