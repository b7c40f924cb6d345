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
#include "mesh/corner_normals.h"
#include "scene/scene.h"

/* Returns the normals of all corners; NULL if the arena failed. `degrees`: 0..180; a face at exactly this angle counts.
 * The result takes 4 bytes per corner and 16 per normal; or 16 per corner, if that is less. Until then it takes 20 per
 * corner, and the larger of 20 per position and about 9 per vertex, and 4 per position; with smoothing groups, 4 per
 * corner more; crease_fans.h takes more. If cancelled, returns early with undefined normals. */
const struct zr_crease_normals *zr_crease_normals_make(const struct zr_run *run, const struct zr_mesh *mesh,
                                                       float degrees);

#endif
